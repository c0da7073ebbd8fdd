#include <spawn.h>
#include <sys/wait.h>

#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <suture/base/Collective.hpp>
#include <suture/base/Version.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>

#include "Loop.hpp"
#include "Orders.hpp"

extern char** environ;

namespace suture::study {
namespace {

namespace fs = std::filesystem;

// Calls the plot script next to this program. \return why there are no plots, or ""
std::string draw(const std::string& folder) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  std::string script = (self.parent_path() / "suture_plot").string(), quiet = "--quiet", where = folder;
  if (!fs::exists(script, error)) return "missing script " + script;
  char* arguments[] = {script.data(), quiet.data(), where.data(), nullptr};
  pid_t child;
  const int failed = posix_spawn(&child, script.c_str(), nullptr, nullptr, arguments, environ);
  if (failed != 0) return script + " cannot be run (is python3 installed?)";
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : script + " failed (see its message above)";
}

std::vector<Verdict> judge(const Study& study, const std::vector<Row>& rows) {
  std::vector<Verdict> verdicts = judgeBands(study, rows);
  const std::vector<Verdict> orders = judgeOrders(study, rows);
  verdicts.insert(verdicts.end(), orders.begin(), orders.end());
  return verdicts;
}

int countOf(const std::vector<Row>& rows, const std::function<bool(ExitCode)>& is) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return is(static_cast<ExitCode>(row.exitCode)); }));
}

void printVerdicts(const std::vector<Verdict>& verdicts, bool quiet) {
  for (const Verdict& verdict : verdicts) {
    const bool missed = verdict.judged && !verdict.kept;
    if (quiet && !missed) continue;
    (missed ? std::cerr : std::cout) << "  "
                                     << (!verdict.judged ? "not run"
                                         : missed        ? "MISSED "
                                                         : "kept   ")
                                     << "  " << verdict.band << ": " << verdict.sentence << std::endl;
  }
}

}  // namespace

void writeTables(const Comm& comm, const Study& study, const std::vector<Row>& rows, const std::string& folder) {
  const std::vector<Verdict> verdicts = judge(study, rows);
  std::string text = "# " + study.title + "\n\n`" + study.name + ".xml`, " + counted(comm.getSize(), "rank") + ", Suture " + version() +
                     " (" + commit() + ")\n\n" + tableMarkdown(study, rows);
  if (!verdicts.empty()) text += "\n" + bandsMarkdown(verdicts);
  writeTextFile((fs::path(folder) / "table.csv").string(), tableCsv(study, rows));
  writeTextFile((fs::path(folder) / "table.md").string(), text);
  writeTextFile((fs::path(folder) / "study.json").string(), tableJson(study, rows));
}

ExitCode reportStudy(const Comm& comm, const Study& study, const Rows& all, const Options& options) {
  const std::string folder = options.folder();
  int missed = 0, failed = 0, bugs = 0;
  collectivelyOnRoot(comm, "writing the tables of the study", [&] {
    const std::vector<Verdict> verdicts = judge(study, all.rows);
    writeTables(comm, study, all.rows, folder);
    const std::string noPictures = study.plots.empty() ? "" : draw(folder);
    if (!options.quiet) {
      std::cout << "  " << folder << "/  table.csv  table.md  study.json" << (study.plots.empty() || !noPictures.empty() ? "" : "  *.png")
                << std::endl;
      if (!noPictures.empty()) std::cout << "  no plots: " << noPictures << std::endl;
    }
    printVerdicts(verdicts, options.quiet);
    missed = static_cast<int>(std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& one) { return one.judged && !one.kept; }));
    failed = countOf(all.rows, [](ExitCode code) { return code != ExitCode::Done; });
    bugs = countOf(all.rows, [](ExitCode code) { return code == ExitCode::Internal; });
    if (missed > 0)
      std::cerr << "suture_study: " << missed << (missed == 1 ? " band or order" : " bands or orders") << " missed" << std::endl;
    if (failed > 0 && (!study.allowFailures || !options.quiet))
      (study.allowFailures ? std::cout : std::cerr) << "suture_study: " << counted(failed, "run") << " without a solution" << std::endl;
    if (bugs > 0)
      std::cerr << "suture_study: " << counted(bugs, "run") << " failed by a bug in Suture: please report it together with the scene"
                << std::endl;
  });
  std::vector<int> counts{missed, failed, bugs};
  broadcast(comm, counts);
  if (all.stopped) return ExitCode::Stopped;
  if (counts[2] > 0) return ExitCode::Internal;
  return counts[0] > 0 || (counts[1] > 0 && !study.allowFailures) ? ExitCode::Numerical : ExitCode::Done;
}

}  // namespace suture::study
