#pragma once
#include <suture/simulation/Stages.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// --print-defaults: prints the resolved scene as XML on standard output.
RunResult printDefaults(const Comm& comm, const SceneFile& file);

/// Prints the header of the console; with --check even if --quiet is set, because the sizes are the result.
void printSizes(const Comm& comm, const PreparedScene& scene, const SolveOptions& options);

/// --check: prints the estimated memory of a run, and that no errors were found.
void printChecked(const Comm& comm, const PreparedScene& scene);

/// With --quiet, prints why a run failed; otherwise only the exit code would show it.
void printFailure(const Comm& comm, const JudgedScene& scene, const SolveOptions& options);

}  // namespace suture
