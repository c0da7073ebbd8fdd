#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <suture/base/Version.hpp>
#include <suture/report/Console.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/Transmissions.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

namespace fs = std::filesystem;

namespace suture {
namespace {

constexpr const char* kFields = "fields_0000.vtkhdf";
constexpr const char* kCheckpoint = "checkpoint.h5";
constexpr double kExactMesh = 0.01;  // error of the mesh, in per cent, below which its digits mean nothing

std::string titleOf(const SceneFile& scene) {
  const Parameters& all = *scene.parameters;
  const std::string title = all.isType<std::string>("Title") ? all.get<std::string>("Title") : "";
  return title.empty() ? fs::path(scene.path).filename().string() : title;
}

// "converged: 3 outer, 22 + 8 PCG, residual 2.0e-09; 87 of 89 pairs closed, ..."
std::string ending(const Run& run, double largestDisplacement) {
  const Solution& answer = run.solution;
  const Units units = unitsOf(*run.scene.parameters);
  std::string line = answer.converged ? "converged: " : run.monitor.in(RunMonitor::Colour::Bad, "not converged: ");
  if (!answer.converged && !answer.failure.empty()) line += answer.failure + "; ";
  if (answer.outerSolver.empty())
    line += answer.auxiliary.pcg == 0 ? "no interface iteration" : format("%d PCG", answer.auxiliary.pcg);
  else
    line += format("%d outer, %d + %d PCG", answer.iterations, answer.pcgTotal, answer.auxiliary.pcg);
  line += format(", residual %.1e; ", answer.residual);
  if (run.size.pairs > 0) {
    const ContactFigures contact = contactFigures(answer, run.size.pieces);
    line += grouped(contact.active) + " of " + counted(contact.pairs, "pair") +
            format(" closed, largest gap %.3e %s, largest pressure %.2e %s", contact.maxGap, units.length.c_str(), contact.maxPressure,
                   units.stress.c_str());
    if (const FrictionFigures& friction = contact.friction; friction.pairs > 0) {
      line += ", " + grouped(friction.sticking) + " stick, " + grouped(friction.slipping) + " slip";
      if (friction.bound > 0.0) line += format(", friction mobilised up to %.0f %%", 100 * friction.maxMobilisation);
    }
    if (contact.touching > 0) line += ", " + grouped(contact.touching) + (contact.touching == 1 ? " touches" : " touch") + " without force";
  } else {
    line += format("largest displacement %.3e %s", largestDisplacement, units.length.c_str());
  }
  if (!answer.undetermined.empty()) line = run.monitor.in(RunMonitor::Colour::Bad, "NOT DETERMINED: ") + answer.undetermined + "\n" + line;
  return line + format(", forces balance to %.0e", answer.verification.balance.imbalance);
}

// "verified: balance, supports and contact hold to the automatic tolerance of 1.2e-04; nearest to its bound: residual 2.1e-09 of 1.0e-06
// (body 'left', (0, 3))"
std::string verdict(const Run& run) {
  const RunMonitor& monitor = run.monitor;
  const Verification& verification = run.solution.verification;
  const Check* worst = verification.worst();
  if (!worst) return "";
  if (!verification.holds()) return "   " + monitor.in(RunMonitor::Colour::Bad, "NOT VERIFIED: ") + verification.failure() + "\n";
  std::string line = "   " + monitor.in(RunMonitor::Colour::Good, "verified:") + " forces, supports and contact hold";
  if (isAutomatic(*run.scene.parameters) && run.solution.discretisation)
    line += format(" to the automatic tolerance of %.1e", requestedAccuracy(*run.scene.parameters, run.solution));
  if (worst->value > 0.0)
    line += format("; nearest to its bound: %s %.1e of %.1e", worst->name.c_str(), worst->value, worst->bound) + " (" + worst->where + ")";
  return line + "\n";
}

// "   mesh error about 4 % in the energy norm, from averaged stresses"
std::string meshError(const Solution& answer) {
  if (answer.discretisation || answer.meshError.value_or(0.0) == 0.0) return "";
  const double share = 100 * *answer.meshError;
  if (share < kExactMesh) return format("   mesh error below %g %% in the energy norm, from averaged stresses\n", kExactMesh);
  return format(share < 10 ? "   mesh error about %.2g %% in the energy norm, from averaged stresses\n"
                           : "   mesh error about %.0f %% in the energy norm, from averaged stresses\n",
                share);
}

// "   path: 12 load steps to t = 2; work of the loads 1.2e-03, stored 1.0e-03, by friction 2e-04 N m; step size error 0.4 %"
std::string pathWork(const Run& run) {
  if (run.steps.empty()) return "";
  const StepRow& last = run.steps.back();
  const Units units = unitsOf(*run.scene.parameters);
  return format("   path: %s to t = %g; work of the loads %.3e, stored %.3e, by friction %.3e %s %s; step size error %.2g %%\n",
                counted(last.step, "load step").c_str(), last.time, last.work.external, last.work.stored, last.work.dissipated,
                units.force.c_str(), units.length.c_str(), 100 * last.work.stepError());
}

// "errors: displacement L2 1.234e-05 (0.012 %), energy norm ...": against the exact solution, if the scene has one.
std::string exactErrors(const std::map<std::string, double>& errors) {
  std::string line;
  for (const auto& [key, name] : {std::pair<const char*, const char*>{"displacement_l2", "displacement L2"},
                                  {"energy_norm", "energy norm"},
                                  {"pressure_l2", "pressure L2"}}) {
    const auto error = errors.find(key), relative = errors.find(std::string(key) + "_relative");
    if (error == errors.end()) continue;
    line += format("%s%s %.3e", line.empty() ? "   errors: " : ", ", name, error->second);
    if (relative != errors.end()) line += format(" (%.2g %%)", 100 * relative->second);
  }
  return line.empty() ? "" : line + "\n";
}

// "   error in the energy norm, estimated: discretisation 4.1e-02 (2.1 %), algebraic 3.2e-03 (0.16 %)"
std::string estimatedErrors(const Solution& answer) {
  if (!answer.discretisation) return "";
  const DiscretisationError& estimate = *answer.discretisation;
  std::string line =
      format("   error in the energy norm, estimated: discretisation %.2e (%.2g %%)", estimate.energyNorm, 100 * estimate.relative());
  if (answer.energyError >= 0.0 && estimate.solutionNorm > 0.0)
    line += format(", algebraic %.2e (%.2g %%)", answer.energyError, 100 * answer.energyError / estimate.solutionNorm);
  const auto exact = answer.errors.find("energy_norm");
  if (exact != answer.errors.end() && exact->second > 0.0) line += format("; effectivity %.2f", estimate.energyNorm / exact->second);
  return line + "\n";
}

/// The value rounded up to this number of digits: a bound must not be printed smaller than it is.
double roundedUp(double value, int digits) {
  if (!(value > 0.0) || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1);
  return std::ceil(value / unit * (1 - 1e-12)) * unit;
}

// "   error in the energy norm: at most 1.2e-02 (0.9 %), proved for the polygon of the mesh"
std::string boundText(const Solution& answer, int dimension) {
  if (!answer.bound) return "";
  const ErrorBound& bound = *answer.bound;
  std::string reasons;
  for (const std::string& reason : bound.reasons) reasons += (reasons.empty() ? "" : "; ") + reason;
  if (!bound.exists) return "   error in the energy norm: no bound, because " + reasons + "\n";
  const std::string value = format("%.2e (%.2g %%)", roundedUp(bound.total, 3), roundedUp(100 * bound.relative(), 2));
  if (bound.strict)
    return "   error in the energy norm: at most " + value + ", proved for the " + (dimension == 2 ? "polygon" : "polyhedron") +
           " of the mesh\n";
  return "   error in the energy norm, estimated: " + value + "; no bound, because " + reasons + "\n";
}

// "   accuracy: error of the energy norm 0.82 % (bound), requested 1 %; 2 meshes"
std::string accuracy(const Run& run) {
  if (!run.accuracy) return "";
  const AccuracyReached& reached = *run.accuracy;
  const std::string failure = reached.failure();
  if (!failure.empty()) return "   " + run.monitor.in(RunMonitor::Colour::Bad, "ACCURACY NOT REACHED: ") + failure + "\n";
  const std::string name = reached.quantity == AccuracyRequest::kEnergy ? "the energy norm" : reached.quantity;
  const double geometry = 100 * reached.geometry.value_or(0.0);
  const std::string sides = geometry > 0.0 ? format(" for the polygon of the mesh, whose straight sides add about %.1g %%", geometry) : "";
  return format("   accuracy: the error of %s is %s %.2g %%%s; requested %.3g %%; %s\n", name.c_str(), reached.strict ? "at most" : "about",
                roundedUp(100 * reached.reached, 2), sides.c_str(), 100 * reached.requested,
                reached.levels.size() == 1 ? "1 mesh" : (grouped(static_cast<long long>(reached.levels.size())) + " meshes").c_str());
}

// "   forces of contacts and supports: estimated error up to 1.2e+00 N (error bars in summary.json)"
std::string forceErrors(const Run& run) {
  if (!run.solution.errorBars) return "";
  return format("   forces of contacts and supports: estimated error up to %.1e %s, see force_error in summary.json\n",
                largestForceError(run), unitsOf(*run.scene.parameters).force.c_str()) +
         intervalsText(run, run.model.dimension);
}

fs::path fileOf(const Run& run, const std::string& name) { return fs::path(run.folder) / name; }

/// "   to try: ..., from where this run ended: --restart "out/checkpoint.h5" --set "Outer Solver/Maximum Iterations=10"" at the limit.
std::string moreIterations(const Run& run) {
  const int limit = run.scene.parameters->sublist("Outer Solver").get<int>("Maximum Iterations");
  const fs::path checkpoint = fileOf(run, kCheckpoint);
  if (run.solution.iterations < limit || !fs::exists(checkpoint)) return "";
  return "   to try: more iterations, from where this run ended: --restart \"" + checkpoint.string() +
         "\" --set \"Outer Solver/Maximum Iterations=" + std::to_string(10 * std::max(limit, 1)) + "\"\n";
}

/// Suggestions for a run without a valid solution; excludes the present solver, and all solvers if there is no equilibrium. Empty if no
/// advice is needed: a stopped run only needs more time, and undetermined motions have their own advice.
std::string whatToTry(const Run& run) {
  std::string text;
  const Solution& answer = run.solution;
  if (answer.isValid() || answer.stopped || !answer.undetermined.empty()) return text;
  const bool refused = answer.failure.find("no equilibrium") != std::string::npos;
  const bool frictional =
      std::any_of(answer.pairs.begin(), answer.pairs.end(), [](const PairResult& pair) { return pair.kind.restrictsSliding; });
  const bool inSteps = !run.steps.empty() || answer.failure.rfind("load step", 0) == 0;
  if (!answer.converged && !refused && !inSteps) text += moreIterations(run);
  if (!refused && run.scene.parameters->sublist("Outer Solver").get<std::string>("Type") != "Monolithic")
    text +=
        "   to try: --set \"Outer Solver/Type=Monolithic\", which needs neither subdomains nor conjugate gradients, shows whether the "
        "scene is at fault\n";
  if (!answer.converged && !refused && frictional && !inSteps)
    text += "   to try: Load Steps: with friction the solution depends on the load path, and each step starts close to its solution\n";
  if (fs::exists(fileOf(run, kFields)) || !run.steps.empty())
    text += "   suture_plot " + run.folder + " draws supports and contacts (scene.png)\n";
  return text + advice("   ");
}

/// Names of the files that a run may have written, in the order in which the console lists them.
std::vector<std::string> filesOf(const Run& run) {
  const Parameters& scene = *run.scene.parameters;
  const bool isRequested =
      scene.isSublist("Output") && scene.sublist("Output").isType<bool>("Checkpoint") && scene.sublist("Output").get<bool>("Checkpoint");
  std::vector<std::string> names{kFields, "contact_0000.vtkhdf"};
  if (!run.steps.empty()) names = {"fields.vtkhdf.series", "contact.vtkhdf.series", "steps.csv", "frames.csv", "rigid_groups.csv"};
  // A valid run leaves the checkpoint of an earlier run in place.
  if (!run.steps.empty() || !run.solution.isValid() || isRequested) names.emplace_back(kCheckpoint);
  names.insert(names.end(), {"contact.csv", "reactions.csv"});
  for (const Probe& probe : readProbes(scene, run.model.bodies)) names.push_back(probe.fileName());
  for (const Transmission& one : readTransmissions(scene)) names.push_back(one.fileName());
  names.insert(names.end(), {"history.csv", "summary.json"});
  return names;
}

}  // namespace

void printHeader(std::ostream& console, const Comm& comm, const SceneFile& scene, const ProblemSize& size) {
  console << "Suture " << version() << " (" << commit() << ")   " << titleOf(scene) << "   " << counted(comm.getSize(), "rank") << ", "
          << counted(size.subdomains, "subdomain") << "   " << counted(size.elements, "element") << ", " << counted(size.dofs, "unknown");
  console << ", " << grouped(size.interfaceDofs) << " on the interface";
  if (size.pairs > 0) console << ", " << counted(size.pairs, "pair") << " in " << counted(size.pieces, "piece");
  console << std::endl;
}

std::string advice(const std::string& indent) { return indent + "doc/convergence.md lists causes and remedies\n"; }

void printFooter(std::ostream& console, const Run& run, const RunFigures& figures) {
  console << ending(run, figures.largestDisplacement) << "\n"
          << verdict(run) << meshError(run.solution) << whatToTry(run) << pathWork(run) << exactErrors(run.solution.errors)
          << estimatedErrors(run.solution) << boundText(run.solution, run.model.dimension) << forceErrors(run) << accuracy(run)
          << extremesText(run, figures.dimension);
  for (const Timers::Statistics& phase : figures.phases) console << format("   %s %.2f s", phase.phase.c_str(), phase.max);
  console << format("   total %.2f s   peak %.0f MB per rank\n", run.timers.total(), figures.memory.max);
  std::string folder = run.folder;
  if (folder.empty() || folder.back() != '/') folder += '/';
  console << "   " << folder;
  for (const std::string& name : filesOf(run))
    if (fs::exists(fileOf(run, name))) console << "  " << name;
  console << std::endl;
}

}  // namespace suture
