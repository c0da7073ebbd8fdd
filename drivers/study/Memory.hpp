#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Combinations.hpp"

namespace suture::study {

/// Result of a combination, stored in the combination's folder so that an interrupted study can continue (--continue).
struct FinishedRun {
  std::vector<std::string> summaries;  ///< texts of summary.json, one per repetition
  int exitCode = 0;
  std::string failure;
};

/// The stored run of a combination, if `folder` contains one by the same program, with the same scene file, overrides, number of ranks and
/// repetitions. A damaged file is ignored. Local.
std::optional<FinishedRun> finishedRun(const std::string& folder, const Combination& run, int repetitions, int ranks);

/// Stores a run in `folder`, which exists. \throws EnvironmentError. Local.
void keepRun(const std::string& folder, const Combination& run, int repetitions, int ranks, const FinishedRun& finished);

}  // namespace suture::study
