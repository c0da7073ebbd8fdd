#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/simulation/Stages.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// --again: repeats the run of `options.again` with a separate output folder and compares the two summaries.
/// \param subject  for error messages; becomes the scene once it is known
/// \return the exit code of the run, or Numerical if it is 0 and the results do not agree. Collective.
/// \throws InputError  no summary, or scene, mesh or checkpoint differ from those of the run;  CommandLineError  the output folder is that
/// of the record
ExitCode solveAgain(const CommPtr& comm, SolveOptions options, std::string& subject);

/// Refuses a scene whose parameters differ from the record, and notes a file with other changes. No effect without a record. Local.
void sameScene(const SolveOptions& options, const SceneFile& file, RunMonitor& monitor);

/// Refuses a mesh that differs from the record. No effect without a record. Collective.
void sameMesh(const Comm& comm, const SolveOptions& options, const PartitionedScene& scene);

}  // namespace suture
