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
  std::string summary;  ///< text of summary.json on rank 0, elsewhere nothing
  RunFigures figures;
};

/// True if the scene asks for fields. Local.
bool wantsFields(const Parameters& scene);

/// fields_0000.vtkhdf (and contact_0000.vtkhdf with contact lines), history.csv, summary.json, and steps.csv
/// of a scene with load steps, whose fields are in place already (writeStepFields). All of them are written into a folder `.new`
/// first; only when all are complete do they replace those of an earlier run, one rename each, summary.json last. The files are written
/// also for a run that did not converge; summary.json says so. Files of an earlier run into the same folder that this one does not write
/// are removed. Its time is the phase "write" of the run's timers. No rank has anything to do once the results are in place: a run that
/// fails later would leave a summary that does not know it. Collective.
/// \throws EnvironmentError  when something cannot be written
Written writeReport(const Run& run, ExitCode code);

}  // namespace suture
