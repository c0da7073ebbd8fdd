#include <suture/solver/BodyImbalance.hpp>
#include <suture/solver/InterfaceSolves.hpp>
#include <suture/solver/NonsymmetricSolver.hpp>
#include <suture/solver/SpringPreconditioner.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace suture {

namespace {
constexpr int kRestarts = 6;           // maximum number of restarts of conjugate gradients whose recursive residual has drifted
constexpr double kStalled = 0.5;       // reduction of global and body residuals by a restart above which they stagnate at round-off
constexpr double kPairDigits = 1e-12;  // round-off of a pair force relative to the largest in its cluster
constexpr int kRescales = 4;           // maximum number of further solves because the solution is smaller than assumed
constexpr double kKept =
    0.02;  // least factor on the tolerance inherited from the previous final set: a body that needed a smaller one may be free now
constexpr double kOverestimate = 2.0;  // overestimate of the energy norm of the solution above which a solve is resumed
}  // namespace

InterfaceSolves::InterfaceSolves(OuterSolver::Run& run, double inner)
    : run_(run),
      contact_(*run.problem.contact()),
      inner_(std::max(inner, run.tolerance())),
      step_(run.problem.space()->vector()),
      scales_(run, contact_),
      deformed_(run.given) {
  if (contact_.laws().restrictSliding()) {
    run_.automatic.tighten();
    run_.preconditioner = Teuchos::rcp(new SpringPreconditioner(run_.preconditioner));
    return;
  }
  if (!run.fromAuxiliary) return;
  // The auxiliary solve can be resumed if there is one cluster, whose scaling it has.
  preconditioned_ = run.preconditioned;
  hasPreconditioner_ = true;
  matrix_ = run.bilateral;
  deformed_ = true;
  scales_.setReference(run.reference);
  PairStates states = contact_.statesOf(preconditioned_);
  scales_.find(states);
  if (scales_.oneCluster()) last_ = std::move(states);
}

void InterfaceSolves::precondition(const InterfaceState& state, const Teuchos::RCP<InterfaceOperator>& matrix) {
  if (hasPreconditioner_ && run_.problem.differing(preconditioned_, state.status).empty()) return;
  hasPreconditioner_ = false;  // also if this fails
  run_.preconditioner->initialize(matrix->space());
  run_.preconditioner->compute(matrix);
  preconditioned_ = state.status;
  hasPreconditioner_ = true;
  run_.describe(*matrix);
}

/// Between the loosest and the tightest tolerance.
double InterfaceSolves::middle() const { return std::sqrt(inner_ * tightest()); }

/// At the end the residual of each body is small compared with its energy, so its pairs have their own resolution. With friction, pairs
/// keep that of their cluster.
PairResolution InterfaceSolves::finalResolution() const {
  const double final = tightest();
  PairResolution result = resolution(final);
  if (contact_.laws().restrictSliding()) return result;
  result.ofCluster = std::min(kPairDigits, final);
  result.ofBody = final;
  return result;
}

PairResolution InterfaceSolves::resolution(double tolerance) const { return {tolerance, 0.0, scales_.unloaded()}; }

/// Global residual, or the largest residual or imbalance of a body, if that is larger; tolerances are tightened then.
double InterfaceSolves::norm(const PairValues& values, const InterfaceState& state) {
  const double final = tightest();
  const ClusterScales::Norm found = scales_.norm(*values.residual, state);
  whole_ = found.whole;
  double residual = found.largest();
  if (residual > found.whole && found.whole <= final && found.bodies > final)
    sharper_ = std::min(sharper_, kSharper * found.whole / found.bodies);
  if (residual > final) return residual;
  const double forces = bodyImbalance(contact_.bodies(), values.force, contact_.energies(state), scales_.largestEnergies()) / kImbalance;
  if (forces <= final) return residual;
  sharper_ = std::min(sharper_, kSharper * residual / forces);
  return forces;
}

void InterfaceSolves::evaluateStart() {
  InterfaceState state = run_.result.state;
  state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
  int applications = run_.problem.conform(state);
  applications += contact_.remember(state);
  const PairStates states = contact_.statesOf(state.status);
  if (contact_.bodies().rigid().loose(states).cols() > 0) return;
  const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
  precondition(state, linear.matrix);
  deformed_ = true;
  scales_.find(states);
  scales_.scaleBy(&state, state, *linear.load);
  run_.automatic.startsFrom(std::sqrt(contact_.energies(state).sum()));
  const PairValues values = contact_.valuesOf(state);
  run_.evaluation = evaluationOf(contact_, states, values, answerOf(contact_, states, values, finalResolution()));
  run_.result.pcgTotal += applications + values.applications;
  run_.result.otherApplications += applications + values.applications;
  run_.result.residual = scales_.norm(*values.residual, state).largest();
  run_.result.energyError = scales_.largest() * scales_.reference() * run_.result.residual;
  run_.result.state = state;
  run_.confirm();
}

/// Chooses the start of the solve with the second set. The first set is a guess, which may be far off (a long slab that no pair carries
/// bends under its load by more than its length). The choice is between the state of the first solve and the original start: the one with
/// less energy after closing the gaps of the set.
void InterfaceSolves::chooseOrigin(const InterfaceState& from, InterfaceState& state, int& applications) {
  if (!deformed_) {
    start_ = from;
    start_.status = state.status;
  }
  if (start_.trace.is_null() || run_.problem.differing(start_.status, state.status).empty()) return;
  InterfaceState first = std::exchange(start_, InterfaceState());
  first.status = state.status;
  const auto energy = [&](const InterfaceState& at) { return contact_.valuesOf(at).energy; };
  const double own = energy(state);
  if (own <= energy(first)) return;
  first.trace = Teuchos::rcp(new MultiVector(*first.trace, Teuchos::Copy));
  applications += run_.problem.conform(first);
  if (own <= energy(first)) return;
  state = std::move(first);
  deformed_ = false;
}

/// Starts or resumes a linear solve and updates the state.
bool InterfaceSolves::solveLinear(InterfaceState& state, bool goOn, double tolerance, const EnergyCriterion& criterion, InnerResult& cost,
                                  int& applications) {
  if (goOn) {
    matrix_->record();
    cost = run_.inner.goOn(*step_, tolerance, scales_.reference(), run_.monitor, criterion);
  } else {
    applications += contact_.remember(state);
    const InterfaceState from = state;
    state.trace = Teuchos::rcp(new MultiVector(*state.trace, Teuchos::Copy));
    applications += run_.problem.conform(state);
    chooseOrigin(from, state, applications);
    const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
    matrix_ = linear.matrix;
    precondition(state, matrix_);
    scales_.scaleBy(deformed_ ? &from : nullptr, state, *linear.load);
    scales_.scale(*linear.load, true);
    if (matrix_->symmetric()) {
      matrix_->record();
      cost = run_.inner.solve(matrix_, run_.preconditioner, *linear.load, *step_, tolerance, scales_.reference(), run_.monitor, criterion);
    } else {
      cost = solveNonsymmetric(matrix_, run_.preconditioner, *linear.load, *step_, tolerance, scales_.reference(),
                               run_.settings.maximumInnerIterations);
    }
    if (scales_.reference() == 0.0) scales_.setReference(!cost.history.empty() && cost.history.front() > 0.0 ? cost.reference : 0.0);
  }
  if (matrix_->symmetric()) run_.learn(cost);
  const Matrix image = matrix_->symmetric() ? matrix_->recorded(cost.steps) : Matrix();
  if (!cost.converged) return false;
  scales_.scale(*step_, false);
  run_.problem.update(state, *step_, 1.0, scales_.isScaled() || !matrix_->symmetric() ? nullptr : &image);
  applications += contact_.remember(state);
  deformed_ = true;
  return true;
}

/// Solves until the residual is small compared with the energy of the solution.
bool InterfaceSolves::oneSolve(InterfaceState& state, bool goOn, double requested, InnerResult& cost, int& applications) {
  const double tolerance = sharper_ * requested, final = tightest();
  const EnergyCriterion criterion{nullptr, run_.lowest};
  bool solved = solveLinear(state, goOn, tolerance, criterion, cost, applications);
  for (int again = 0; solved && again < kRescales; ++again) {
    const double over = scales_.overestimate(state, tolerance);
    if (over * cost.residual <= tolerance || over < kOverestimate) break;
    InnerResult more;
    const bool continues = !scales_.isScaled() && canGoOn();
    if (continues) scales_.setReference(scales_.reference() / over);
    solved = solveLinear(state, continues, tolerance, criterion, more, applications);
    more.pcg += cost.pcg;
    cost = std::move(more);
  }
  // Without an iteration nothing changes: the start was accurate enough already (e.g. a nested one). Use the next tolerance.
  if (solved && requested > final && cost.pcg == 0 && cost.residual > sharper_ * final)
    return oneSolve(state, goOn && canGoOn(), requested > middle() ? middle() : final, cost, applications);
  if (solved) {
    scales_.recordSolution(state, tolerance);
    return true;
  }
  run_.result.pcgTotal += cost.pcg + applications;
  run_.result.otherApplications += applications;
  return false;
}

ContactAnswer InterfaceSolves::failed(std::string reason) {
  run_.result.failure = std::move(reason);
  last_.clear();
  ContactAnswer answer;
  answer.solved = false;
  return answer;
}

ContactAnswer InterfaceSolves::solve(const PairStates& states, double tolerance) {
  const bool isFinal = tolerance <= tightest();
  bool goOn = states == last_ && canGoOn();
  if (!goOn) {
    scales_.find(states);
    sharper_ = isFinal ? std::max(sharper_, kKept) : 1.0;  // bodies that needed a smaller tolerance in the last set do in the next one
  }
  last_ = states;
  double before = 0.0, wholeBefore = 0.0;
  try {
    for (int pass = 0;; ++pass) {
      const double final = tightest(), requested = isFinal ? std::min(tolerance, final) : tolerance;
      InterfaceState state = run_.result.state;
      state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
      state.status = contact_.statusOf(states);
      InnerResult cost;
      int applications = 0;
      if (!oneSolve(state, goOn, requested, cost, applications))
        return failed("a linear solve did not reach its tolerance within " + std::to_string(run_.settings.maximumInnerIterations) +
                      " iterations; a Preconditioner/BDDC/Edge Constraints of Adaptive may help");
      // The accuracy of the states is that of the solve.
      double residual = cost.residual;
      PairValues values = contact_.valuesOf(state);
      ContactAnswer answer = answerOf(contact_, states, values, resolution(std::max(final, std::min(sharper_ * requested, residual))));
      InterfaceProblem::Evaluation at = evaluationOf(contact_, states, values, answer);
      bool drifted = false, sharpened = false;
      const bool confirms = isFinal || (at.settled && residual <= final);
      if (confirms) {  // confirm the recursive residual by applying the operator
        state.memory.reset();
        contact_.separate(state);
        applications += contact_.remember(state);
        const double sharper = sharper_;
        values = contact_.valuesOf(state);
        answer = answerOf(contact_, states, values, finalResolution());
        at = evaluationOf(contact_, states, values, answer);
        residual = norm(values, state);
        sharpened = sharper_ < sharper;
        drifted = residual > final;
      }
      if (!std::isfinite(residual)) throw NumericalError("a residual is not a number");
      cost.pcg += applications + at.applications;
      run_.result.otherApplications += applications + at.applications;
      run_.accept(std::move(state), std::move(at), residual, cost, 1.0,
                  cost.energyErrors.empty() ? -1.0 : scales_.largest() * cost.energyErrors.back());
      run_.result.state.status = contact_.statusOf(states);
      const bool wantsMore = isFinal && !drifted && residual > tightest();  // by a new estimate of the discretisation error
      if (!drifted && !wantsMore) return answer;
      const bool stalled = pass > 0 && residual > kStalled * before && whole_ > kStalled * wholeBefore;
      if ((stalled && !goOn) || pass >= kRestarts) {
        run_.atFloor = true;
        last_.clear();
        return answer;
      }
      before = wantsMore ? std::numeric_limits<double>::infinity() : residual;
      wholeBefore = whole_;
      goOn = (sharpened || wantsMore) && !stalled && canGoOn();  // a stalled recursion is restarted
    }
  } catch (const NumericalError& error) {
    return failed(error.what());
  }
}

}  // namespace suture
