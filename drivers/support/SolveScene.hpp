#pragma once
#include <suture/base/Types.hpp>
#include <suture/simulation/Simulation.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// From a scene file to the files of a run: the whole of suture_solve, and one run of suture_study. Plugins must be loaded before.
/// Collective over `comm`. \throws Error  of any kind, the same on all ranks
RunResult solveScene(const CommPtr& comm, const SolveOptions& options);

}  // namespace suture
