#include <spawn.h>
#include <sys/wait.h>

#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <filesystem>
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

// The script beside this program. \return why there are no pictures, or ""
std::string draw(const std::string& folder) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  std::string script = (self.parent_path() / "suture_study_plot").string(), quiet = "--quiet", where = folder;
  if (!fs::exists(script, error)) return "there is no " + script;
  char* arguments[] = {script.data(), quiet.data(), where.data(), nullptr};
  pid_t child;
  const int failed = posix_spawn(&child, script.c_str(), nullptr, nullptr, arguments, environ);
  if (failed != 0) return script + " cannot be run (is python3 installed?)";
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : script + " failed (its message stands above)";
}

void writeTables(const Comm& comm, const Study& study, const Rows& all, const std::vector<Verdict>& verdicts, const std::string& folder) {
  std::string text = "# " + study.title + "\n\n`" + study.name + ".xml`, " + counted(comm.getSize(), "rank") + ", Suture " + version() +
                     " (" + commit() + ")\n\n" + tableMarkdown(study, all.rows);
  if (!verdicts.empty()) text += "\n" + bandsMarkdown(verdicts);
  writeTextFile((fs::path(folder) / "table.csv").string(), tableCsv(study, all.rows));
  writeTextFile((fs::path(folder) / "table.md").string(), text);
  writeTextFile((fs::path(folder) / "study.json").string(), tableJson(study, all.rows));
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

ExitCode reportStudy(const Comm& comm, const Study& study, const Rows& all, const Options& options) {
  const std::string folder = options.folder();
  int missed = 0, failed = 0;
  collectivelyOnRoot(comm, "writing the tables of the study", [&] {
    std::vector<Verdict> verdicts = judgeBands(study, all.rows);
    const std::vector<Verdict> orders = judgeOrders(study, all.rows);
    verdicts.insert(verdicts.end(), orders.begin(), orders.end());
    writeTables(comm, study, all, verdicts, folder);
    const std::string noPictures = study.plots.empty() ? "" : draw(folder);
    if (!options.quiet) {
      std::cout << "  " << folder << "/  table.csv  table.md  study.json" << (study.plots.empty() || !noPictures.empty() ? "" : "  *.png")
                << std::endl;
      if (!noPictures.empty()) std::cout << "  no pictures: " << noPictures << std::endl;
    }
    printVerdicts(verdicts, options.quiet);
    missed = static_cast<int>(std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& one) { return one.judged && !one.kept; }));
    failed = static_cast<int>(std::count_if(all.rows.begin(), all.rows.end(), [](const Row& row) { return row.exitCode != 0; }));
    if (missed > 0)
      std::cerr << "suture_study: " << missed << (missed == 1 ? " band or order" : " bands or orders") << " missed" << std::endl;
    if (failed > 0 && (!study.allowFailures || !options.quiet))
      (study.allowFailures ? std::cout : std::cerr) << "suture_study: " << counted(failed, "run") << " without a solution" << std::endl;
  });
  std::vector<int> counts{missed, failed};
  broadcast(comm, counts);
  if (all.stopped) return ExitCode::Stopped;
  return counts[0] > 0 || (counts[1] > 0 && !study.allowFailures) ? ExitCode::Numerical : ExitCode::Done;
}

}  // namespace suture::study
