#pragma once
#include <suture/base/Errors.hpp>
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// summary.json: the figures of a run under the names of DESIGN.md section 3, quantities in the units of the scene, vectors with as many
/// components as the scene has dimensions. A number that is not finite is null. Collective; rank 0 writes.
/// \throws EnvironmentError
void writeSummary(const Run& run, ExitCode code, const std::string& path);

}  // namespace suture
