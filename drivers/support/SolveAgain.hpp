#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/simulation/Simulation.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// --again: makes the run of `options.again` once more, into a folder of its own, and compares the two summaries.
/// \param subject  of error messages: becomes the scene once it is known
/// \return the exit code of the run; where that is 0 and the results do not agree, Numerical. Collective.
/// \throws InputError  no summary, or the scene, its mesh or the checkpoint are not those of the run;  CommandLineError  the output folder
/// is that of the record
ExitCode solveAgain(const CommPtr& comm, SolveOptions options, std::string& subject);

/// Nothing without a record; else refuses a scene with other parameters, and notes a file that has changed all the same. Local.
void sameScene(const SolveOptions& options, const SceneFile& file, RunMonitor& monitor);

/// Nothing without a record; else refuses another mesh. After Simulation::cut(). Collective.
void sameMesh(const Comm& comm, const SolveOptions& options, const Simulation& simulation);

}  // namespace suture
