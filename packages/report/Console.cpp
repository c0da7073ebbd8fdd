#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <ostream>
#include <suture/base/Version.hpp>
#include <suture/report/Console.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Units.hpp>

namespace suture {
namespace {

std::string titleOf(const SceneFile& scene) {
  const Parameters& all = *scene.parameters;
  const std::string title = all.isType<std::string>("Title") ? all.get<std::string>("Title") : "";
  return title.empty() ? std::filesystem::path(scene.path).filename().string() : title;
}

// "converged: 3 outer, 22 + 8 PCG, residual 2.0e-09; 87 of 89 pairs closed, ..."
std::string verdict(const Run& run, double largestDisplacement) {
  const Solution& answer = run.solution;
  const Units units = unitsOf(*run.scene.parameters);
  std::string line = answer.converged ? "converged: " : "not converged: ";
  if (!answer.converged && !answer.failure.empty()) line += answer.failure + "; ";
  if (answer.outerSolver.empty())
    line += answer.auxiliary.pcg == 0 ? "no interface iteration" : format("%d PCG", answer.auxiliary.pcg);
  else
    line += format("%d outer, %d + %d PCG", answer.outerIterations, answer.pcgTotal, answer.auxiliary.pcg);
  line += format(", residual %.1e; ", answer.residual);
  if (run.size.pairs > 0) {
    const ContactFigures contact = contactFigures(answer.pairs, run.size.pieces);
    line += format("%d of %d pairs closed, largest gap %.3e %s, largest pressure %.2e %s", contact.active, contact.pairs, contact.maxGap,
                   units.length.c_str(), contact.maxPressure, units.stress.c_str());
  } else {
    line += format("largest displacement %.3e %s", largestDisplacement, units.length.c_str());
  }
  return line + format(", forces balance to %.0e", answer.imbalance);
}

// "   error in the energy norm: discretisation 4.1e-02 (2.1 %) estimated, algebraic 3.2e-03 (0.16 %)"
std::string errorLine(const Solution& answer) {
  if (!answer.discretisation) return "";
  const DiscretisationError& estimate = *answer.discretisation;
  std::string line =
      format("   error in the energy norm, estimated: discretisation %.2e (%.2g %%)", estimate.energyNorm, 100 * estimate.relative());
  if (answer.energyError >= 0.0 && estimate.solutionNorm > 0.0)
    line += format(", algebraic %.2e (%.2g %%)", answer.energyError, 100 * answer.energyError / estimate.solutionNorm);
  return line + "\n";
}

}  // namespace

void printHeader(std::ostream& console, const Comm& comm, const SceneFile& scene, const ProblemSize& size) {
  console << "Suture " << version() << " (" << commit() << ")   " << titleOf(scene) << "   " << counted(comm.getSize(), "rank") << ", "
          << counted(size.subdomains, "subdomain") << "   " << counted(size.elements, "element") << ", " << counted(size.dofs, "unknown");
  console << ", " << grouped(size.interfaceDofs) << " on the interface";
  if (size.pairs > 0) console << ", " << counted(size.pairs, "pair") << " in " << counted(size.pieces, "piece");
  console << std::endl;
}

void printFooter(std::ostream* console, const Run& run) {
  const double largest = maxDisplacement(run);
  const std::vector<Timers::Statistics> phases = run.timers.statistics(run.comm);
  const Memory memory = peakMemory(run.comm);
  if (!console || run.comm.getRank() != 0) return;

  *console << verdict(run, largest) << "\n" << errorLine(run.solution);
  for (const Timers::Statistics& phase : phases) *console << format("   %s %.2f s", phase.phase.c_str(), phase.max);
  *console << format("   total %.2f s   peak %.0f MB a rank\n", run.timers.total(), memory.max);
  std::string folder = run.folder;
  if (folder.empty() || folder.back() != '/') folder += '/';
  *console << "   " << folder;
  for (const char* name : {"fields_0000.vtkhdf", "contact_0000.vtkhdf", "history.csv", "summary.json"})
    if (std::filesystem::exists(std::filesystem::path(run.folder) / name)) *console << "  " << name;
  *console << std::endl;
}

}  // namespace suture
