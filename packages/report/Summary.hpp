#pragma once
#include <suture/base/Errors.hpp>
#include <suture/report/Figures.hpp>

#include <string>
#include <vector>

namespace suture {

/// Text of summary.json: the figures of a run under the names of doc/output.md, in the units of the scene; vectors have as many
/// components as the scene has dimensions. A number that is not finite is null. On rank 0, empty on other ranks. Collective.
std::string summaryText(const Run& run, const RunFigures& figures, ExitCode code);

/// Writes summary.json. Collective; rank 0 writes.
/// \return the text written, on rank 0; empty on other ranks
/// \throws EnvironmentError
std::string writeSummary(const Run& run, const RunFigures& figures, ExitCode code, const std::string& path);

/// The names of all numbers and texts in summary.json, as paths with dots ("outer.pcg_total"). A part in angle brackets is a name from
/// the scene or a list index ("contact.force.<piece>.<component>"); any path may follow "parameters". Local.
const std::vector<std::string>& summaryPaths();

}  // namespace suture
