// Runs a scene with many values of some of its parameters and writes one table: speed against error, iterations against size, and whether
// the figures lie in the bands that the study asserts.
#include <Teuchos_Comm.hpp>
#include <suture/report/OutputFolder.hpp>

#include "support/Plugins.hpp"
#include "support/StudyLoop.hpp"

using namespace suture;

namespace {

ExitCode run(const CommPtr& comm, const StudyOptions& options) {
  loadPlugins(options.plugins);
  const Study study = readStudy(*comm, options.study, options.ofTheStudy);
  Problems problems;
  const StudyFilter only = readOnly(study, options.only, problems);
  const std::vector<StudyRun> runs = combinations(study, options.overrides, only, problems);
  problems.throwIfAny();
  checkRuns(*comm, study, runs);
  if (options.check) {
    listRuns(*comm, study, runs);
    return ExitCode::Done;
  }
  prepareFolder(*comm, options.folder());
  const FolderLock lock(*comm, options.folder());
  const StudyRows rows = runAll(comm, study, runs, options);
  return reportStudy(*comm, study, rows, options);
}

}  // namespace

int main(int argc, char* argv[]) {
  StudyOptions options;
  if (const auto end = options.parse(argc, argv)) return *end;
  return runProgram("suture_study", options.study, [&](const CommPtr& comm) { return run(comm, options); });
}
