#include <suture/base/Collective.hpp>
#include <suture/solver/BalanceForces.hpp>
#include <suture/solver/Decomposition.hpp>
#include <suture/solver/SolveInterface.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

namespace suture {

void Decomposition::doAssemble(Subdomains subdomains) {
  subdomains_ = std::move(subdomains);
  assemble(*scene().comm, subdomains_);
}

void Decomposition::doFactor() {
  problem_ = makeInterfaceProblem(scene().comm, scene().partition, subdomains_, scene().settings, scene().laws);
}

Solution Decomposition::doSolve(Monitor& monitor, const Start* start, const Keep& keep) {
  const CutScene& given = scene();
  std::optional<InterfaceState> from;
  problem_->rememberPath(start ? start->carried : std::vector<BodyForces>());
  if (start) from = stateOf(*start, *problem_, subdomains_);
  AutomaticTolerance::Estimate discretisationError;
  if (isAutomatic(given.settings)) {
    discretisationError = discretisationErrorOf(*given.comm, given.meshes, given.model, subdomains_);
    if (start) discretisationError.predicted = start->predictedError;
  }
  const auto solutionOf = [&](const OuterResult& result) { return recover(*given.comm, *problem_, result, subdomains_, given.settings); };
  const auto accepted = [&](const InterfaceState& state) {
    keep([&] {
      OuterResult result;
      result.state = state;
      return solutionOf(result);
    });
  };
  const bool balances = wantsErrorBound(given.settings);
  Teuchos::RCP<Preconditioner> made;  // kept only for balancing
  OuterResult result = solveInterface(*problem_, given.settings, monitor, from ? &*from : nullptr, discretisationError,
                                      keep ? accepted : std::function<void(const InterfaceState&)>(),
                                      given.inSteps ? &preconditioner_
                                      : balances    ? &made
                                                    : nullptr,
                                      start ? start->tolerance : 0.0);
  if (!result.converged && result.slides.size() > 0)
    result.failure = slidesAway(problem_->contact()->bodies(), result.slides, given.model.bodies,
                                problem_->contact()->laws().restrictSliding(), result.multiple);
  if (!result.converged && !result.unsettled.empty())
    result.failure += unsettled(*problem_->contact(), result.unsettled, given.contacts, given.model.bodies,
                                result.iterations >= given.settings.sublist("Outer Solver").get<int>("Maximum Iterations"));
  Solution solution = solutionOf(result);
  if (balances) addBalancing(result, given.inSteps ? preconditioner_ : made, solution);
  return solution;
}

/// \param preconditioner  of the solution; null if it needed none
void Decomposition::addBalancing(const OuterResult& result, Teuchos::RCP<Preconditioner> preconditioner, Solution& solution) const {
  if (!solution.converged) {
    solution.notBalanced = "the run did not converge";
    return;
  }
  if (preconditioner.is_null()) preconditioner = makePreconditioner(scene().settings.sublist("Preconditioner"));
  BalancedForces balanced = balanceForces(*problem_, result.state, *preconditioner, subdomains_);
  solution.balancing = std::move(balanced.balancing);
  solution.notBalanced = std::move(balanced.reason);
}

void Decomposition::doReload() {
  collectively(*scene().comm, "loading the subdomains", [&] {
    for (const auto& subdomain : subdomains_) subdomain->reload();
  });
  problem_->reload();
}

bool Decomposition::doRearrange() {
  if (!problem_->rearranges()) return false;
  int mine = 1, all = 0;
  collectively(*scene().comm, "loading the subdomains", [&] {
    for (const auto& subdomain : subdomains_) mine = mine && subdomain->rearrange();
  });
  Teuchos::reduceAll(*scene().comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  if (all == 0) return false;
  problem_->rearrange();
  return true;
}

bool Decomposition::knowsFriction(const Parameters& settings) const {
  return formulationOf(settings)->knowsFriction() && makeStrategy<OuterSolver>(settings.sublist("Outer Solver"), "Type")->knowsFriction();
}

Subdomains Decomposition::takeSubdomains() {
  preconditioner_ = Teuchos::null;
  problem_.reset();
  releaseFollowers(subdomains_);
  return std::move(subdomains_);
}

}  // namespace suture
