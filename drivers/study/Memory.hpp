#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Combinations.hpp"

namespace suture::study {

/// Result of a combination of a study, as it is kept in the combination's folder, so that an interrupted study can go on (--continue).
struct FinishedRun {
  std::vector<std::string> summaries;  ///< texts of summary.json, one a repetition
  int exitCode = 0;
  std::string failure;
};

/// The run of this combination, if `folder` has it and was made by the same program from the same scene file with the same changes, on as
/// many ranks and as often repeated. A damaged file is as good as none. Local.
std::optional<FinishedRun> finishedRun(const std::string& folder, const Combination& run, int repetitions, int ranks);

/// Keeps it in `folder`, which exists. \throws EnvironmentError. Local.
void keepRun(const std::string& folder, const Combination& run, int repetitions, int ranks, const FinishedRun& finished);

}  // namespace suture::study
