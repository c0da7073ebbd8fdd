#include "Loop.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <filesystem>
#include <iostream>
#include <new>
#include <suture/base/Timers.hpp>
#include <suture/report/Format.hpp>

#include <suture/base/Collective.hpp>

#include "../support/SolveScene.hpp"
#include "../support/StopSignals.hpp"
#include "Memory.hpp"

namespace suture::study {
namespace {

struct Outcome {
  Explanation end{ExitCode::Done, ""};
  std::string summary;
};

// Runs once; an exception is an outcome, so that a failed run does not end the study.
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
  } catch (const std::bad_alloc&) {
    outcome.end = {ExitCode::Environment, "out of memory"};
  } catch (const std::exception& error) {
    outcome.end = {ExitCode::Internal, error.what()};
  }
  outcome.end = meeting.settle(outcome.end);
  return outcome;
}

std::string folderOf(const Combination& run, const Options& options) {
  return (std::filesystem::path(options.folder()) / "runs" / format("%03d", run.number)).string();
}

SolveOptions optionsOf(const Combination& run, const Options& options) {
  SolveOptions own;
  own.scene = run.scene;
  own.overrides = run.overrides;
  own.overrides.push_back("Output/Folder=" + folderOf(run, options));
  own.plugins = options.plugins;
  own.quiet = true;
  own.commandLine = options.commandLine;
  return own;
}

std::string figures(const Study& study, const Row& row) {
  std::string text;
  for (std::size_t c = 0; c < study.columns.size(); ++c)
    for (const char* wanted : {"dofs", "steps", "pcg", "condition"})
      if (study.columns[c].name == wanted && row.cells[c].kind != TableCell::Kind::Empty)
        text += std::string("  ") + wanted + " " + shown(row.cells[c]);
  return text;
}

}  // namespace

namespace {

FinishedRun solveRun(const CommPtr& comm, const MeetingPoint& meeting, const Study& study, const Combination& run, const Options& options) {
  FinishedRun own;
  Outcome last;
  for (int repetition = 0; repetition < study.repetitions && last.end.code == ExitCode::Done; ++repetition) {
    resetPeakMemory();
    last = attempt(comm, meeting, optionsOf(run, options));
    if (!last.summary.empty()) own.summaries.push_back(last.summary);
  }
  if (last.end.code == ExitCode::Done) return own;
  // If a repetition failed, the row reports that repetition.
  if (!last.summary.empty()) own.summaries = {last.summary};
  own.exitCode = int(last.end.code);
  own.failure = last.end.message;
  return own;
}

}  // namespace

Rows runAll(const CommPtr& comm, const Study& study, const std::vector<Combination>& runs, const Options& options) {
  const MeetingPoint meeting(*comm);
  std::ostream* console = consoleOf(*comm, options.quiet);
  if (console)
    *console << "Study: " << study.title << "   " << counted(comm->getSize(), "rank") << ", "
             << counted(static_cast<long long>(runs.size()), "combination") << std::endl;
  Rows all;
  for (const Combination& run : runs) {
    const double begin = Timers::now();
    const std::string folder = folderOf(run, options);
    const int ranks = comm->getSize();
    FinishedRun own;
    std::vector<int> known{0};
    if (options.goOn) {
      collectivelyOnRoot(*comm, "reading what the study has done", [&] {
        if (const auto kept = finishedRun(folder, run, study.repetitions, ranks)) {
          own = *kept;
          known[0] = 1;
        }
      });
      broadcast(*comm, known);
    }
    if (known[0] == 0) own = solveRun(comm, meeting, study, run, options);
    if (comm->getRank() == 0) {
      all.rows.push_back(studyRow(study, run, own.summaries, own.exitCode, own.failure));
      if (console)
        *console << format("%4zu of %zu  ", std::size_t(&run - runs.data()) + 1, runs.size()) << labelsOf(study, run)
                 << figures(study, all.rows.back()) << (known[0] != 0 ? "  done before" : format("  %.2f s", Timers::now() - begin))
                 << (own.exitCode != 0 ? "  exit code " + std::to_string(own.exitCode) + ": " + all.rows.back().failure : "") << std::endl;
    }
    // Write now, since the next run may end the process.
    collectivelyOnRoot(*comm, "writing the tables of the study", [&] { writeTables(*comm, study, all.rows, options.folder()); });
    if (known[0] != 0) continue;
    // Not stored if another attempt may succeed: after a stop, a failure of the machine, or a bug of Suture.
    const auto end = static_cast<ExitCode>(own.exitCode);
    if (end == ExitCode::Done || end == ExitCode::Numerical || end == ExitCode::Input)
      collectivelyOnRoot(*comm, "keeping what a run of the study gave", [&] {
        std::filesystem::create_directories(folder);  // a refused run has none
        keepRun(folder, run, study.repetitions, ranks, own);
      });
    // A run without outer iterations does not check for requests itself.
    const int asked = stopWasAsked();
    int any = 0;
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, asked, Teuchos::outArg(any));
    all.stopped = any != 0;
    if (all.stopped) break;
  }
  if (console && all.stopped) *console << "  stopped; continue with --continue" << std::endl;
  return all;
}

void listRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs) {
  std::ostream* console = consoleOf(comm, false);
  if (!console) return;
  *console << study.title << "\n";
  for (const Combination& run : runs) {
    *console << format("%4d  ", run.number) << labelsOf(study, run) << "   " << run.scene << "\n";
    for (const std::string& assignment : run.overrides) *console << "        " << assignment << "\n";
  }
  *console << counted(static_cast<long long>(runs.size()), "run") << "; no errors found; not run (--check)" << std::endl;
}

}  // namespace suture::study
