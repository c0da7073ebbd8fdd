#pragma once
#include <suture/base/Types.hpp>
#include <suture/simulation/Stages.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// Runs suture_solve, or one run of suture_study, from the scene file to the result files. Plugins must be loaded before.
/// Collective over `comm`. \throws Error  of any kind, the same on all ranks
RunResult solveScene(const CommPtr& comm, const SolveOptions& options);

}  // namespace suture
