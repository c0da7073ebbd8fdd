#pragma once
#include <string>
#include <suture/base/Errors.hpp>
#include <suture/base/Types.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// How a run ended.
struct RunResult {
  ExitCode code = ExitCode::Done;
  std::string failure = {};  ///< why it did not converge
  std::string summary = {};  ///< on rank 0: the text of summary.json; empty with --check and --print-defaults
};

/// From a scene file to the files of a run: the whole of suture_solve, and one run of suture_study. Plugins must be loaded before.
/// Collective over `comm`. \throws Error  of any kind, the same on all ranks
RunResult solveScene(const CommPtr& comm, const SolveOptions& options);

}  // namespace suture
