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

void printChecked(const Comm& comm, const PreparedScene& scene) {
  std::ostream* console = consoleOf(comm, false);
  if (!console) return;
  *console << "   about " << grouped(static_cast<long>(std::ceil(scene.megabytes()))) << " MB of memory for a run\n"
           << "   no errors found; not solved (--check)" << std::endl;
}

void printFailure(const Comm& comm, const JudgedScene& scene, const SolveOptions& options) {
  if (!options.quiet || comm.getRank() != 0 || scene.ending() == ExitCode::Done) return;
  const Solution& solution = scene.solution();
  std::cerr << "suture_solve: " << (solution.converged ? "" : "not converged: ") << solution.failure << std::endl;
}

}  // namespace suture
