#include <suture/answer/bound/ErrorBound.hpp>
#include <suture/answer/error/AveragedEstimate.hpp>
#include <suture/answer/error/ExactErrors.hpp>
#include <suture/answer/solvability/NeutralMotions.hpp>
#include <suture/answer/solvability/UndeterminedForces.hpp>
#include <suture/answer/values/NodalStresses.hpp>
#include <suture/answer/values/SingularExtremes.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/base/Collective.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/LoadPath.hpp>
#include <suture/simulation/accuracy/ForceIntervals.hpp>
#include <suture/solver/BalanceForces.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <limits>

namespace suture {

namespace {
constexpr std::size_t kNotes = 3;  // groups of contacts with undetermined forces that are named on the console

/// True if any subdomain has its own physics. Collective.
bool hasOwnPhysics(const Comm& comm, const Subdomains& subdomains) {
  const int mine =
      std::any_of(subdomains.begin(), subdomains.end(), [](const auto& subdomain) { return subdomain && !subdomain->followsModel(); });
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any != 0;
}

}  // namespace

bool wantsErrorEstimate(const Parameters& settings) {
  return settings.sublist("Output").get<bool>("Error Estimate") || wantsErrorBars(settings) || isAutomatic(settings) ||
         AccuracyRequest::of(settings);
}

bool wantsErrorBars(const Parameters& settings) {
  if (settings.sublist("Output").get<bool>("Error Bars") || !strictBarsOf(settings).empty()) return true;
  const std::optional<AccuracyRequest> accuracy = AccuracyRequest::of(settings);
  return accuracy && !accuracy->isEnergy();
}

bool wantsNodalStresses(const Parameters& settings) { return settings.sublist("Output").get<bool>("Nodal Stresses"); }

void settleMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces, const Scene& scene,
                   const LoadPath* path, Solution& solution, Monitor& monitor) {
  const std::vector<BodyForces> carried = path ? path->carried() : std::vector<BodyForces>();
  if (solution.converged) settleNeutralMotions(comm, meshes, scene.model, scene.laws, carried, solution);
  if (solution.converged) settleContactForces(comm, meshes, scene.laws, scene.contacts, solution);
  const std::size_t shared = solution.sharedForces.size();
  for (std::size_t i = 0; i < std::min(shared, kNotes); ++i) monitor.note(inWords(solution.sharedForces[i]));
  if (shared > kNotes)
    monitor.note("the forces of " + std::to_string(shared - kNotes) +
                 " more groups of contacts are not determined: undetermined_forces in summary.json lists them");
  if (comm.getRank() == 0) solution.onAxis = axisResults(pieces, solution.pairs);
  for (const NeutralMotion& motion : solution.neutral) monitor.note(inWords(motion));
  if (scene.settings().sublist("Outer Solver").get<std::string>("Neutral Motions") != "Least")
    solution.undetermined = undetermined(solution.neutral);
  if (!solution.undetermined.empty()) solution.failure = solution.undetermined;
}

void findErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution, Timers& timers) {
  const ElasticModel& model = scene.model;
  if (!model.exact.empty())
    solution.errors = timed(timers, "errors", [&] {
      return exactErrors(comm, meshes, model, scene.settings().sublist("Contact"), solution.displacement, solution.pairs);
    });
  const bool nodal = wantsNodalStresses(scene.settings());
  if (!nodal && !(wantsErrorEstimate(scene.settings()) && !solution.discretisation)) return;
  const std::vector<PatchRecovery> recovered =
      timed(timers, "recover", [&] { return recoverStresses(comm, meshes, model, solution.displacement); });
  if (wantsErrorEstimate(scene.settings()) && !solution.discretisation)
    solution.discretisation = timed(timers, "estimate", [&] { return estimateError(comm, recovered); });
  if (nodal) solution.nodalStresses = timed(timers, "recover", [&] { return nodalStresses(comm, meshes, model, recovered); });
}

void boundError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const Scene& scene,
                const BoundaryParts& parts, bool followsPath, Solution& solution, Timers& timers) {
  if (!wantsErrorBound(scene.settings())) return;
  std::vector<std::string> reasons;
  if (followsPath && scene.laws.restrictSliding()) reasons.push_back("the solution depends on the path of its load steps");
  if (hasOwnPhysics(comm, subdomains)) {
    solution.bound.emplace();
    solution.bound->reasons.push_back("a body has its own physics");
    return;
  }
  solution.bound = timed(timers, "bound", [&] {
    return errorBound(comm,
                      {meshes, scene.model, solution.displacement, solution.balancing, solution.pairs, parts, solution.energy, reasons,
                       solution.notBalanced},
                      scene.laws);
  });
}

void estimateMesh(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const Scene& scene,
                  const LoadPath* path, Solution& solution, Timers& timers) {
  if (solution.discretisation || !scene.settings().sublist("Output").get<bool>("Mesh Error")) return;
  if (hasOwnPhysics(comm, subdomains)) return;
  EarlierEnergy earlier{0.0, requestedAccuracy(scene.settings(), solution)};
  if (path)
    for (const BodyForces& body : path->carried()) earlier.twice += body.energy();
  solution.meshError =
      timed(timers, "estimate", [&] { return averagedEstimate(comm, meshes, scene.model, solution.displacement, earlier); });
}

namespace {

/// Removes stresses that were recovered with a wrong law.
void forgetOwn(const Solution& solution, std::vector<Matrix>& nodal) {
  for (const auto& own : solution.ownStresses) nodal[own.first].setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<Matrix> recoveredStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                      const Solution& solution) {
  std::vector<Matrix> nodal = nodalStresses(comm, meshes, model, recoverStresses(comm, meshes, model, solution.displacement));
  forgetOwn(solution, nodal);
  return nodal;
}

void findAnswers(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution) {
  if (!solution.nodalStresses.empty()) forgetOwn(solution, solution.nodalStresses);
  const SearchedFields fields{meshes, scene.model, solution.displacement, solution.ownStresses, solution.nodalStresses};
  solution.extremes = findExtremes(comm, fields);
  solution.safety = findSafety(comm, fields);
  solution.rigidGroups = rigidGroupMotions(comm, meshes, solution.displacement);
  if (solution.sinceTime) solution.extremes.displacementSince = largestVector(comm, meshes, solution.since);
}

void findErrorBars(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, const std::vector<ContactPiece>& pieces,
                   const Solution& shown, Solution& solution) {
  if (!wantsErrorBars(scene.settings()) || !solution.converged || !solution.discretisation) return;
  const double norm = solution.discretisation->solutionNorm;
  ErrorBars& bars = solution.errorBars.emplace();
  bars.discretisation = solution.discretisation->relative();
  bars.algebraic = norm > 0.0 ? std::max(0.0, solution.energyError) / norm : 0.0;
  bars.turning = largestTurning(pieces, shown.pairs);
  findSharedNodes(comm, meshes, bars);
  bars.singular = singularExtremes(comm, meshes, scene.model, shown, {"von_mises", "tension", "compression", "pressure"});
}

void verifySolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces,
                    const Subdomains& subdomains, const Scene& scene, const LoadPath* path, Solution& solution) {
  const auto own = [&](int mesh) -> std::optional<OwnForces> {
    if (subdomains.empty() || !subdomains[mesh] || subdomains[mesh]->followsModel()) return std::nullopt;
    return OwnForces{subdomains[mesh]->internalForces(solution.displacement[mesh]), subdomains[mesh]->nodalLoads()};
  };
  const double tolerance = requestedAccuracy(scene.settings(), solution);
  solution.verification =
      verify(comm, {meshes, scene.model, solution.displacement, solution.pairs, pieces, tolerance, own,
                    path ? path->carried() : std::vector<BodyForces>(),
                    scene.settings().sublist("Outer Solver").get<std::string>("Type") == "Monolithic", solution.converged});
  if ((!path || path->rows.empty()) && hasControlledLoads(scene))
    solution.verification.checks.push_back(targetCheck(comm, scene, meshes, solution));
  collectively(comm, "finding the stresses", [&] {
    for (std::size_t i = 0; i < subdomains.size(); ++i)
      if (subdomains[i] && !subdomains[i]->followsModel())
        solution.ownStresses[static_cast<int>(i)] = subdomains[i]->stresses(solution.displacement[i]);
  });
  if (solution.converged && !solution.verification.holds())
    solution.failure = "the verdict does not hold: " + solution.verification.failure();
}

}  // namespace suture
