#pragma once
#include <suture/simulation/Simulation.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// --print-defaults: the resolved scene as XML on standard output.
RunResult printDefaults(const Comm& comm, const SceneFile& file);

/// The header of the console; for --check also with --quiet: its sizes are what was asked for.
void printSizes(const Comm& comm, const Simulation& simulation, const SolveOptions& options);

/// --check: how much memory a run would take, and that nothing wrong was found.
void printChecked(const Comm& comm, const Simulation& simulation);

/// With --quiet, why a run did not end well: the exit code would be all that tells.
void printFailure(const Comm& comm, const Simulation& simulation, const SolveOptions& options);

}  // namespace suture
