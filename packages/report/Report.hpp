#pragma once
#include <suture/base/Errors.hpp>
#include <suture/report/Console.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/Run.hpp>
#include <suture/report/RunMonitor.hpp>

namespace suture {

/// Results of writing a report, for the console.
struct Written {
  std::string summary;  ///< text of summary.json on rank 0, empty on other ranks
  RunFigures figures;
};

/// True if the scene requests fields. Local.
bool wantsFields(const Parameters& scene);

/// Writes fields_0000.vtkhdf, contact_0000.vtkhdf (with contact lines), history.csv, summary.json and, with load steps, steps.csv; the
/// fields of load steps are already in place (writeStepFields). All files are written into a folder `.new` first. Once all are complete,
/// they replace those of an earlier run, one rename each, summary.json last; other result files of the earlier run are removed. A run that
/// did not converge writes the same files, and summary.json states it. The time counts as phase "write" of the run's timers. No rank may
/// do any work after this call: if the run failed later, the summary would not contain the failure. Collective.
/// \throws EnvironmentError  a file cannot be written
Written writeReport(const Run& run, ExitCode code);

}  // namespace suture
