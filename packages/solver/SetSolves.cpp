#include <suture/solver/BodyImbalance.hpp>
#include <suture/solver/SetSolves.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace suture {

namespace {
constexpr int kRestarts = 6;           // maximum number of restarts of conjugate gradients whose recursive residual has drifted
constexpr double kStalled = 0.5;       // reduction of global and body residuals by a restart above which they stagnate at round-off
constexpr double kPairDigits = 1e-12;  // round-off of a pair force relative to the largest in its cluster
constexpr int kRescales = 4;
constexpr double kKept =
    0.02;  // least factor on the tolerance inherited from the previous final set: a body that needed a smaller one may be free now
constexpr double kOverestimate = 2.0;  // overestimate of the energy norm of the solution above which a solve is resumed
}  // namespace

SetSolves::SetSolves(OuterSolver::Run& run, double inner)
    : run_(run),
      sets_(*run.problem.sets()),
      inner_(std::max(inner, run.settings.tolerance)),
      step_(run.problem.space()->vector()),
      scales_(run, sets_) {
  if (!run.fromAuxiliary) return;
  // The auxiliary solve can be resumed if there is one cluster, whose scaling it has.
  preconditioned_ = run.preconditioned;
  hasPreconditioner_ = true;
  matrix_ = run.bilateral;
  deformed_ = true;
  scales_.setReference(run.reference);
  const ClosedSet closed = sets_.closedSet(preconditioned_);
  scales_.find(closed);
  if (scales_.oneCluster()) closed_ = closed;
}

void SetSolves::precondition(const InterfaceState& state, const Teuchos::RCP<InterfaceOperator>& matrix) {
  const bool first = !hasPreconditioner_;
  if (!first && run_.problem.differing(preconditioned_, state.status).empty()) return;
  run_.preconditioner->initialize(matrix->space());
  run_.preconditioner->compute(matrix);
  preconditioned_ = state.status;
  hasPreconditioner_ = true;
  if (first) run_.describe(*matrix);
}

/// Between the loosest and the tightest tolerance.
double SetSolves::middle() const { return std::sqrt(inner_ * run_.settings.tolerance); }

/// At the end the residual of each body is small compared with its energy, so its pairs have their own resolution.
PairResolution SetSolves::finalResolution() const {
  const double final = run_.settings.tolerance;
  return run_.automatic.on() ? PairResolution{final} : PairResolution{std::min(kPairDigits, final), final};
}

/// Global residual, or the largest residual of a body, if that is larger; tolerances are tightened then.
double SetSolves::norm(const MultiVector& residual, const InterfaceState& state) {
  const ClusterScales::Norm found = scales_.norm(residual, state);
  whole_ = found.whole;
  if (found.bodies <= found.whole) return found.whole;
  const double final = run_.settings.tolerance;
  if (found.whole <= final && found.bodies > final) sharper_ = std::min(sharper_, kSharper * found.whole / found.bodies);
  return found.bodies;
}

void SetSolves::evaluateStart() {
  InterfaceState state = run_.result.state;
  state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
  int applications = run_.problem.conform(state);
  applications += sets_.remember(state);
  ClosedSet closed = sets_.closedSet(state.status);
  const RigidBodyModel& rigid = sets_.bodies().rigid();
  if (rigid.loosens(closed)) return;
  const ClosedSet carrying = closed;
  for (const int i : rigid.stabilisingPairs(carrying, rigid.loose(carrying))) closed[i] = 1;
  if (closed != carrying) return;
  const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
  precondition(state, linear.matrix);
  deformed_ = true;
  scales_.find(closed);
  scales_.scaleBy(&state, state, *linear.load);
  run_.automatic.startsFrom(scales_.reference());
  run_.evaluation = sets_.evaluateSet(state, finalResolution());
  run_.result.pcgTotal += applications + run_.evaluation.applications;
  run_.result.otherApplications += applications + run_.evaluation.applications;
  run_.result.residual = norm(*run_.evaluation.residual, state);
  run_.result.state = state;
  run_.confirm();
}

/// Chooses the start of the solve with the second set. The first set is a guess, which may be far off (a long slab that no pair carries
/// bends under its load by more than its length). The choice is between the state of the first solve and the original start: the one with
/// less energy after closing the gaps of the set.
void SetSolves::chooseOrigin(const InterfaceState& from, InterfaceState& state, int& applications) {
  if (!deformed_) {
    start_ = from;
    start_.status = state.status;
  }
  if (start_.trace.is_null() || run_.problem.differing(start_.status, state.status).empty()) return;
  InterfaceState first = std::exchange(start_, InterfaceState());
  first.status = state.status;
  const auto energy = [&](const InterfaceState& at) { return sets_.evaluateSet(at, {1.0}).energy; };
  const double own = energy(state);
  if (own <= energy(first)) return;
  first.trace = Teuchos::rcp(new MultiVector(*first.trace, Teuchos::Copy));
  applications += run_.problem.conform(first);
  if (own <= energy(first)) return;
  state = std::move(first);
  deformed_ = false;
}

/// Starts or resumes conjugate gradients and updates the state.
bool SetSolves::solveLinear(InterfaceState& state, bool goOn, double tolerance, const EnergyCriterion& criterion, InnerResult& cost,
                            int& applications) {
  if (goOn) {
    matrix_->record();
    cost = run_.inner.goOn(*step_, tolerance, scales_.reference(), run_.monitor, criterion);
  } else {
    applications += sets_.remember(state);
    const InterfaceState from = state;
    state.trace = Teuchos::rcp(new MultiVector(*state.trace, Teuchos::Copy));
    applications += run_.problem.conform(state);
    chooseOrigin(from, state, applications);
    const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
    matrix_ = linear.matrix;
    precondition(state, matrix_);
    scales_.scaleBy(deformed_ ? &from : nullptr, state, *linear.load);
    scales_.scale(*linear.load, true);
    matrix_->record();
    cost = run_.inner.solve(matrix_, run_.preconditioner, *linear.load, *step_, tolerance, scales_.reference(), run_.monitor, criterion);
    if (scales_.reference() == 0.0) scales_.setReference(cost.history.front() > 0.0 ? cost.reference : 0.0);
  }
  run_.learn(cost);
  const Matrix image = matrix_->recorded(cost.steps);
  if (!cost.converged) return false;
  scales_.scale(*step_, false);
  run_.problem.update(state, *step_, 1.0, scales_.isScaled() ? nullptr : &image);
  applications += sets_.remember(state);
  deformed_ = true;
  return true;
}

/// Solves until the residual is small compared with the energy of the solution.
bool SetSolves::oneSolve(InterfaceState& state, bool goOn, double requested, InnerResult& cost, int& applications) {
  const double tolerance = sharper_ * requested, final = tightest();
  const EnergyCriterion criterion = run_.automatic.criterion(state, run_.lowest, false, requested <= middle());
  bool solved = solveLinear(state, goOn, tolerance, criterion, cost, applications);
  for (int again = 0; solved && again < kRescales; ++again) {
    const double over = scales_.overestimate(state, tolerance);
    if (over * cost.residual <= tolerance || over < kOverestimate) break;
    InnerResult more;
    const bool continues = !scales_.isScaled() && run_.inner.canGoOn();
    if (continues) scales_.setReference(scales_.reference() / over);
    solved = solveLinear(state, continues, tolerance, criterion, more, applications);
    more.pcg += cost.pcg;
    cost = std::move(more);
  }
  // Without an iteration nothing changes: the start was accurate enough already (e.g. a nested one). Use the next tolerance.
  if (solved && requested > final && cost.steps.empty() && cost.residual > sharper_ * final)
    return oneSolve(state, goOn && run_.inner.canGoOn(), requested > middle() ? middle() : final, cost, applications);
  if (solved) {
    scales_.recordSolution(state);
    return true;
  }
  run_.result.pcgTotal += cost.pcg + applications;
  run_.result.otherApplications += applications;
  run_.result.failure = "a linear solve did not reach its tolerance within " + std::to_string(run_.settings.maximumInnerIterations) +
                        " iterations; a Preconditioner/BDDC/Edge Constraints of Adaptive may help";
  return false;
}

ContactAnswer SetSolves::solve(const PairStates& states, double tolerance) {
  const double final = tightest();
  const bool isFinal = tolerance <= final;
  const ClosedSet closed = closedSet(states);
  ContactAnswer answer;
  bool goOn = closed == closed_ && run_.inner.canGoOn();
  if (!goOn) {
    scales_.find(closed);
    sharper_ = isFinal ? std::max(sharper_, kKept) : 1.0;  // bodies that needed a smaller tolerance in the last set do in the next one
  }
  closed_ = closed;
  double before = 0.0, wholeBefore = 0.0;
  try {
    for (int pass = 0;; ++pass) {
      InterfaceState state = run_.result.state;
      state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
      state.status = sets_.statusOf(closed);
      InnerResult cost;
      int applications = 0;
      if (!oneSolve(state, goOn, tolerance, cost, applications)) {
        answer.solved = false;
        closed_.clear();
        return answer;
      }
      // The accuracy of the states is that of the solve.
      InterfaceProblem::Evaluation at = sets_.evaluateSet(state, {std::max(final, std::min(sharper_ * tolerance, cost.residual))});
      double residual = cost.residual;
      bool drifted = false, sharpened = false;
      if (isFinal || (at.settled && residual <= final)) {  // confirm the recursive residual by applying the operator
        state.memory.reset();
        sets_.separate(state);
        applications += sets_.remember(state);
        at = sets_.evaluateSet(state, finalResolution());
        const double sharper = sharper_;
        residual = norm(*at.residual, state);
        if (const double forces = bodyImbalance(sets_.bodies(), at.force, sets_.energies(state), scales_.largestEnergies()) / kImbalance;
            forces > final && residual <= final && !run_.automatic.on()) {
          sharper_ = std::min(sharper_, kSharper * residual / forces);
          residual = forces;
        }
        sharpened = sharper_ < sharper;
        drifted = residual > final;
      }
      if (!std::isfinite(residual)) throw NumericalError("a residual is not a number");
      cost.pcg += applications + at.applications;
      run_.result.otherApplications += applications + at.applications;
      answer.force = answer.jump = Matrix::Zero(at.force.size(), 3);
      answer.force.col(0) = at.force;
      answer.jump.col(0) = at.penetration;
      answer.forceTolerance = at.forceTolerance;
      answer.jumpTolerance = at.penetrationTolerance;
      answer.energy = at.energy;
      run_.accept(std::move(state), std::move(at), residual, cost, 1.0,
                  cost.energyErrors.empty() ? -1.0 : scales_.largest() * cost.energyErrors.back());
      run_.result.state.status = sets_.statusOf(closed);
      if (!drifted) return answer;
      const bool stalled = pass > 0 && residual > kStalled * before && whole_ > kStalled * wholeBefore;
      if ((stalled && !goOn) || pass >= kRestarts) {
        run_.atFloor = true;
        closed_.clear();
        return answer;
      }
      before = residual;
      wholeBefore = whole_;
      goOn = sharpened && !stalled && run_.inner.canGoOn();  // a stalled recursion is restarted
    }
  } catch (const NumericalError& error) {
    run_.result.failure = error.what();
    answer.solved = false;
    closed_.clear();
    return answer;
  }
}

void SetSolves::move(const Vector& motion) { sets_.move(run_.result.state, motion); }

}  // namespace suture
