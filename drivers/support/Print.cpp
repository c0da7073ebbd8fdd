#include "Print.hpp"

#include <Teuchos_Comm.hpp>
#include <cmath>
#include <iostream>
#include <suture/report/Console.hpp>
#include <suture/report/Format.hpp>

#include "Program.hpp"

namespace suture {

RunResult printDefaults(const Comm& comm, const SceneFile& file) {
  if (std::ostream* out = consoleOf(comm, false)) *out << toXml(*file.parameters) << std::flush;
  return {};
}

void printSizes(const Comm& comm, const PreparedScene& scene, const SolveOptions& options) {
  std::ostream* console = consoleOf(comm, options.quiet && !options.check);
  if (!console) return;
  printHeader(*console, comm, scene.scene().file, scene.size());
}

namespace {

/// suture_plot --scene with the same scene, overrides and plugins.
std::string commandToDraw(const SolveOptions& options) {
  std::vector<std::string> words{"suture_plot", "--scene", options.scene};
  for (const std::string& assignment : options.overrides) words.insert(words.end(), {"--set", assignment});
  for (const std::string& plugin : options.plugins) words.insert(words.end(), {"--plugin", plugin});
  return shellCommand(words);
}

}  // namespace

void printChecked(const Comm& comm, const PreparedScene& scene, const SolveOptions& options) {
  std::ostream* console = consoleOf(comm, false);
  if (!console) return;
  *console << "   about " << grouped(static_cast<long>(std::ceil(scene.megabytes()))) << " MB of memory for a run\n"
           << "   no errors found; not solved (--check)\n";
  if (!options.quiet) *console << "   to draw it: " << commandToDraw(options) << "\n";
  *console << std::flush;
}

void printFailure(const Comm& comm, const JudgedScene& scene, const SolveOptions& options) {
  if (!options.quiet || comm.getRank() != 0 || scene.ending() == ExitCode::Done) return;
  const Solution& solution = scene.solution();
  std::cerr << "suture_solve: " << (solution.converged ? "" : "not converged: ") << solution.failure << std::endl;
}

}  // namespace suture
