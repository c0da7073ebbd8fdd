#pragma once
#include <suture/base/Errors.hpp>
#include <suture/report/Figures.hpp>

#include <string>
#include <vector>

namespace suture {

/// Text of summary.json: the figures of a run under the names of doc/output.md, quantities in the units of the scene, vectors with as many
/// components as the scene has dimensions. A number that is not finite is null. On rank 0, elsewhere nothing. Collective.
std::string summaryText(const Run& run, const RunFigures& figures, ExitCode code);

/// Writes it. Collective; rank 0 writes.
/// \return on rank 0 the text written, elsewhere nothing
/// \throws EnvironmentError
std::string writeSummary(const Run& run, const RunFigures& figures, ExitCode code, const std::string& path);

/// The names of all numbers and texts in summary.json, as paths with dots ("outer.pcg_total"). A part in angle brackets stands for a name
/// that the scene gives, or a number of a list ("contact.force.<piece>.<component>"); after "parameters" any path may follow. Local.
const std::vector<std::string>& summaryPaths();

}  // namespace suture
