#include "StudyLoop.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <filesystem>
#include <iostream>
#include <suture/base/Timers.hpp>
#include <suture/report/Format.hpp>

#include "SolveScene.hpp"
#include "SolveStages.hpp"

namespace suture {
namespace {

struct Outcome {
  Explanation end{ExitCode::Done, ""};
  std::string summary;
};

// One run; what it throws is its outcome. Only a bug ends the study.
Outcome attempt(const CommPtr& comm, const MeetingPoint& meeting, const SolveOptions& options) {
  Outcome outcome;
  try {
    const RunResult result = solveScene(comm, options);
    outcome = {{result.code, result.failure}, result.summary};
  } catch (const InputError& error) {
    outcome.end.code = error.code();
    for (const Problem& problem : error.problems())
      outcome.end.message += (outcome.end.message.empty() ? "" : "; ") + problem.path + ": " + problem.message;
  } catch (const Error& error) {
    outcome.end = {error.code(), error.what()};
  }
  outcome.end = meeting.settle(outcome.end);
  if (outcome.end.code == ExitCode::Internal) throw InternalError(outcome.end.message);
  return outcome;
}

SolveOptions optionsOf(const StudyRun& run, const StudyOptions& options) {
  SolveOptions own;
  own.scene = run.scene;
  own.overrides = run.overrides;
  own.overrides.push_back("Output/Folder=" + (std::filesystem::path(options.folder()) / "runs" / format("%03d", run.number)).string());
  own.quiet = true;
  own.commandLine = options.commandLine;
  return own;
}

std::string figures(const Study& study, const StudyRow& row) {
  std::string text;
  for (std::size_t c = 0; c < study.columns.size(); ++c)
    for (const char* wanted : {"dofs", "steps", "pcg", "condition"})
      if (study.columns[c].name == wanted && row.cells[c].kind != StudyCell::Kind::Empty)
        text += std::string("  ") + wanted + " " + shown(row.cells[c]);
  return text;
}

}  // namespace

StudyRows runAll(const CommPtr& comm, const Study& study, const std::vector<StudyRun>& runs, const StudyOptions& options) {
  const MeetingPoint meeting(*comm);
  std::ostream* console = consoleOf(*comm, options.quiet);
  if (console)
    *console << "Study: " << study.title << "   " << counted(comm->getSize(), "rank") << ", "
             << counted(static_cast<long long>(runs.size()), "combination") << std::endl;
  StudyRows all;
  for (const StudyRun& run : runs) {
    const double begin = Timers::now();
    std::vector<std::string> summaries;
    Outcome last;
    for (int repetition = 0; repetition < study.repetitions && last.end.code == ExitCode::Done; ++repetition) {
      resetPeakMemory();
      last = attempt(comm, meeting, optionsOf(run, options));
      if (!last.summary.empty()) summaries.push_back(last.summary);
    }
    const double seconds = Timers::now() - begin;
    const bool failed = last.end.code != ExitCode::Done;
    if (comm->getRank() == 0) {
      // A repetition that failed is what the row tells.
      if (failed && !last.summary.empty()) summaries = {last.summary};
      all.rows.push_back(studyRow(study, run, summaries, int(last.end.code), failed ? last.end.message : ""));
      if (console)
        *console << format("%4zu of %zu  ", std::size_t(&run - runs.data()) + 1, runs.size()) << labelsOf(study, run)
                 << figures(study, all.rows.back()) << format("  %.2f s", seconds)
                 << (failed ? "  exit code " + std::to_string(int(last.end.code)) + ": " + all.rows.back().failure : "") << std::endl;
    }
    // A run without outer iterations does not see the request itself.
    const int asked = stopWasAsked();
    int any = 0;
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, asked, Teuchos::outArg(any));
    all.stopped = any != 0;
    if (all.stopped) break;
  }
  return all;
}

void listRuns(const Comm& comm, const Study& study, const std::vector<StudyRun>& runs) {
  std::ostream* console = consoleOf(comm, false);
  if (!console) return;
  *console << study.title << "\n";
  for (const StudyRun& run : runs) {
    *console << format("%4d  ", run.number) << labelsOf(study, run) << "   " << run.scene << "\n";
    for (const std::string& assignment : run.overrides) *console << "        " << assignment << "\n";
  }
  *console << counted(static_cast<long long>(runs.size()), "run") << "; nothing wrong was found; nothing was run (--check)" << std::endl;
}

}  // namespace suture
