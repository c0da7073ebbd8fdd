#include <suture/base/Errors.hpp>
#include <suture/solver/BalanceForces.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace suture {

namespace {

// Unbalanced forces relative to the largest force: below kRoundOff no further pass is made, above kAccepted the result is of no use.
constexpr double kRoundOff = 1e-15, kAccepted = 1e-10;
constexpr double kSlow = 0.5;  // reduction by a pass above which the rest is round-off
constexpr int kPasses = 60;    // an approximate coarse solve reduces the unbalanced forces by its accuracy, 0.1, in each pass

double largest(const Comm& comm, const MultiVector& x) {
  double mine = 0.0, all = 0.0;
  const auto values = localView(x);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (!(std::abs(values(i, 0)) <= mine)) mine = std::isnan(values(i, 0)) ? HUGE_VAL : std::abs(values(i, 0));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

/// A broken field and the corrections that lead to it.
struct Attempt {
  std::vector<Vector> corrections;
  BrokenField field;
  double rest = 0.0;  // largest unbalanced force
};

/// False if the preconditioner has no broken correction.
bool improve(const InterfaceProblem& problem, const InterfaceState& state, const Preconditioner& preconditioner, Attempt& best) {
  const Comm& comm = *problem.space()->comm();
  const double scale = best.field.largestForce;
  Attempt now = best;
  for (int pass = 0; pass < kPasses && best.rest > kRoundOff * scale; ++pass) {
    std::optional<std::vector<Vector>> added = preconditioner.brokenCorrection(*now.field.residual);
    if (!added) return false;
    for (std::size_t i = 0; i < now.corrections.size(); ++i) (*added)[i] += now.corrections[i];
    now.corrections = *std::move(added);
    now.field = *problem.brokenField(state, now.corrections);
    now.rest = largest(comm, *now.field.residual);
    const bool isSlow = !(now.rest < kSlow * best.rest);
    if (now.rest < best.rest) best = now;
    if (isSlow) break;
  }
  return true;
}

Balancing balancingOf(const Comm& comm, const Subdomains& subdomains, const std::vector<Vector>& before, const Attempt& found) {
  Balancing result;
  double energy = 0.0;
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    if (found.corrections.empty()) {
      result.correction.emplace_back();
      continue;
    }
    const Vector& now = found.field.freeValues[s];
    const Vector change = now - before[s];
    energy += change.dot(subdomains[s]->stiffness() * change);
    result.correction.push_back(subdomains[s]->cartesian(now) - subdomains[s]->cartesian(before[s]));
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, energy, Teuchos::outArg(result.energy));
  for (const PairForce& pair : found.field.pairs) result.forces[pair.id] = pair;
  if (found.field.largestForce > 0.0) result.imbalance = found.rest / found.field.largestForce;
  return result;
}

/// The state with the bounds of friction that its forces have: the friction of slipping pairs then has an energy.
InterfaceState withGivenBounds(const InterfaceProblem& problem, const InterfaceState& state, const BrokenField& field) {
  std::map<int, ContactState> status;
  int mine = 0, any = 0;
  for (const PairForce& pair : field.pairs) {
    ContactState& own = status[pair.id] = pair.state;
    if (!own.couplesToNormal()) continue;
    own.bound = own.largest(pair.force);
    own.friction = 0.0;
    mine = 1;
  }
  Teuchos::reduceAll(*problem.space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any == 0) return state;
  InterfaceState given = state;
  given.status = problem.stateOf(field.freeValues, status).status;
  return given;
}

}  // namespace

bool wantsErrorBound(const Parameters& settings) {
  if (refinesMesh(settings)) return true;
  if (!settings.isSublist("Output")) return false;
  const Parameters& output = settings.sublist("Output");
  return (output.isParameter("Error Bound") && output.get<bool>("Error Bound")) ||
         (output.isParameter("Strict Error Bars") && !output.get<Teuchos::Array<std::string>>("Strict Error Bars").empty());
}

BalancedForces balanceForces(const InterfaceProblem& problem, const InterfaceState& found, Preconditioner& preconditioner,
                             const Subdomains& subdomains) {
  const Comm& comm = *problem.space()->comm();
  Attempt best;
  const std::optional<BrokenField> field = problem.brokenField(found, {});
  if (!field) return {std::nullopt, "the formulation does not offer the forces of its local problems"};
  const InterfaceState state = withGivenBounds(problem, found, *field);
  best.field = *problem.brokenField(state, {});
  best.rest = largest(comm, *best.field.residual);
  const std::vector<Vector> before = best.field.freeValues;
  if (best.rest > kRoundOff * best.field.largestForce) {
    const InterfaceProblem::Linearisation linear = problem.linearise(state);
    if (!linear.matrix->symmetric()) return {std::nullopt, "the friction of slipping pairs depends on normal forces: there is no energy"};
    if (linear.matrix->friction() && !linear.matrix->friction()->motions.is_null())
      return {std::nullopt, "only the friction of slipping pairs holds a body"};
    try {
      preconditioner.initialize(linear.matrix->space());
      preconditioner.compute(linear.matrix);
      if (!improve(problem, state, preconditioner, best)) return {std::nullopt, "the preconditioner offers no balanced forces"};
    } catch (const NumericalError& error) {
      return {std::nullopt, std::string("the forces between subdomains could not be balanced: ") + error.what()};
    }
  }
  if (!(best.rest <= kAccepted * best.field.largestForce)) {
    std::ostringstream text;
    text.precision(1);
    text << std::scientific << "the forces between subdomains balance only to " << best.rest / best.field.largestForce
         << " of the largest force";
    return {std::nullopt, text.str()};
  }
  return {balancingOf(comm, subdomains, before, best), {}};
}

}  // namespace suture
