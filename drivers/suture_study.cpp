// Runs a scene with different values of its parameters and writes one table, e.g. time against error or iterations against size; checks
// that the figures are within the bands of the study. The main function is in study/StudyMain.cpp, since the Python package also runs this
// function.
#include <Teuchos_Comm.hpp>
#include <suture/report/OutputFolder.hpp>

#include "study/Loop.hpp"
#include "support/Plugins.hpp"

namespace suture::study {

ExitCode run(const CommPtr& comm, const Options& options) {
  loadPlugins(options.plugins);
  const Study study = readStudy(*comm, options.study, options.ofTheStudy);
  Problems problems;
  const Filter only = readOnly(study, options.only, problems);
  const std::vector<Combination> runs = combinations(study, options.overrides, only, problems);
  problems.throwIfAny();
  checkRuns(*comm, study, runs);
  if (options.check) {
    listRuns(*comm, study, runs);
    return ExitCode::Done;
  }
  prepareFolder(*comm, options.folder());
  const FolderLock lock(*comm, options.folder());
  const Rows rows = runAll(comm, study, runs, options);
  return reportStudy(*comm, study, rows, options);
}

}  // namespace suture::study
