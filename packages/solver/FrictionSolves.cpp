#include <suture/interface/PlainFlips.hpp>
#include <suture/solver/BodyImbalance.hpp>
#include <suture/solver/FrictionSolves.hpp>
#include <suture/solver/NonsymmetricSolver.hpp>
#include <suture/solver/SpringPreconditioner.hpp>

#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr int kTakenUp = 4;          // maximum number of further solves because the solution is smaller than assumed
constexpr double kTooLarge = 2.0;    // ratio of assumed to actual energy norm of the solution that is too large
constexpr int kBegunAnew = 4;        // maximum number of restarts of a solve whose true residual is larger than reported
constexpr double kBodies = 4.0;      // accepted residual of a body relative to its own energy, in units of the global tolerance
constexpr double kNoProgress = 0.5;  // residual reduction by a restart above which it stagnates at round-off
}  // namespace

FrictionSolves::FrictionSolves(OuterSolver::Run& run, double inner)
    : run_(run), friction_(*run.problem.friction()), sets_(*run.problem.sets()), inner_(std::max(inner, run.settings.tolerance)) {
  run_.preconditioner = Teuchos::rcp(new SpringPreconditioner(run_.preconditioner));
  ofParts_ = sets_.bodies().carriedEnergy();
  largest_ = std::sqrt(ofParts_.sum());
}

void FrictionSolves::precondition(const Teuchos::RCP<InterfaceOperator>& matrix) {
  run_.preconditioner->initialize(matrix->space());
  run_.preconditioner->compute(matrix);
  run_.describe(*matrix);
}

double FrictionSolves::energyNorm(const InterfaceState& state) const {
  return std::sqrt(std::max(sets_.energies(state).cwiseMax(0.0).sum(), 0.0));
}

bool FrictionSolves::linear(InterfaceState& state, double tolerance, InnerResult& cost, int& applications) {
  applications += sets_.remember(state);
  state.trace = Teuchos::rcp(new MultiVector(*state.trace, Teuchos::Copy));
  applications += run_.problem.conform(state);
  const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
  precondition(linear.matrix);
  // The energy norm of the solution is at least that of the correction minus that of the trace. The previous solution may be only
  // round-off, for example if all pairs stick and the prescribed displacements cause all the motion.
  reference_ = std::max(reference_, preconditionedNorm(*run_.preconditioner, *linear.load) - energyNorm(state));
  const MultiVectorPtr step = run_.problem.space()->vector();
  InnerResult more;
  if (linear.matrix->symmetric()) {
    linear.matrix->record();
    more = run_.inner.solve(linear.matrix, run_.preconditioner, *linear.load, *step, tolerance, reference_, run_.monitor);
    run_.learn(more);
    const Matrix image = linear.matrix->recorded(more.steps);
    run_.problem.update(state, *step, 1.0, &image);
  } else {
    more = solveNonsymmetric(linear.matrix, run_.preconditioner, *linear.load, *step, tolerance, reference_,
                             run_.settings.maximumInnerIterations);
    run_.problem.update(state, *step, 1.0);
  }
  applications += sets_.remember(state);
  cost.pcg += more.pcg;
  cost.residual = more.residual;
  cost.condition = more.condition;
  cost.converged = more.converged;
  return more.converged;
}

ContactAnswer FrictionSolves::answerOf(const PairValues& values, const PairStates& states, double resolution) const {
  ContactAnswer answer;
  answer.force = values.force;
  answer.jump = values.jump;
  answer.energy = values.energy;
  const RigidBodyModel& rigid = sets_.bodies().rigid();
  ClosedSet closed;
  for (const ContactState& state : states) closed.push_back(state.closed());
  const Vector size = values.force.rowwise().norm();
  // Without loads, forces are round-off of displacements.
  answer.forceTolerance = (std::max(resolution, kGapDigits) * rigid.clusterScale(closed, size))
                              .cwiseMax(values.digits.cwiseQuotient(rigid.compliance()))
                              .cwiseMax(std::max(1.0, nothing_ / kRoundedForce) * rigid.rounding());
  answer.jumpTolerance = rigid.compliance().cwiseProduct(answer.forceTolerance) + values.digits;
  return answer;
}

/// Global residual; `largest` becomes the largest of this, the residuals of bodies relative to their own energy, and their imbalance.
double FrictionSolves::norm(const PairValues& values, const InterfaceState& state, double& largest) {
  const Vector energy = sets_.energies(state).cwiseMax(0.0), own = productsByPart(sets_, *run_.preconditioner, *values.residual);
  ofParts_ = ofParts_.size() > 0 ? Vector(ofParts_.cwiseMax(energy)) : energy;
  const double whole = largest = reference_ > 0.0 ? std::sqrt(std::max(own.sum(), 0.0)) / reference_ : 0.0;
  if (run_.automatic.on()) return whole;
  largest =
      std::max({whole, bodyResidual(own, energy, ofParts_, Vector::Constant(energy.size(), kPassive * reference_ * reference_)) / kBodies,
                bodyImbalance(sets_.bodies(), values.force, energy, ofParts_) / kImbalance});
  return whole;
}

ContactAnswer FrictionSolves::solve(const PairStates& states, double tolerance) {
  const double final = tightest();
  ContactAnswer answer;
  try {
    InterfaceState state = run_.result.state;
    state.status = friction_.statusOf(states);
    InnerResult cost;
    int applications = 0;
    double residual = 0.0, before = 0.0;
    PairValues values;
    double sharper = 1.0;  // factor on the tolerance for a small residual of each body relative to its own energy
    for (int pass = 0;; ++pass) {
      bool solved = linear(state, sharper * tolerance, cost, applications);
      for (int again = 0; solved && again < kTakenUp; ++again) {
        // The solution of some states may have no energy (a body in rigid motion): the largest energy so far is the scale then.
        const double found = energyNorm(state), negligible = std::max(tolerance, kNegligibleEnergyNorm / final) * largest_,
                     own = std::max(found, negligible);
        nothing_ = found < negligible ? tolerance * negligible / largest_ : 0.0;
        largest_ = std::max(largest_, found);
        if (!(own > 0.0)) break;
        const double over = reference_ / own;
        reference_ = own;
        if (over < kTooLarge || over * cost.residual <= tolerance) break;
        solved = linear(state, sharper * tolerance, cost, applications);
      }
      if (!solved) {
        run_.result.pcgTotal += cost.pcg + applications;
        run_.result.otherApplications += applications;
        run_.result.failure = "a linear solve did not reach its tolerance within " + std::to_string(run_.settings.maximumInnerIterations) +
                              " iterations; a Preconditioner/BDDC/Edge Constraints of Adaptive may help";
        answer.solved = false;
        return answer;
      }
      residual = cost.residual;
      if (tolerance <= final) {  // confirm by applying the operator
        state.memory.reset();
        sets_.separate(state);
        applications += sets_.remember(state);
      }
      values = friction_.valuesOf(state);
      applications += values.applications;
      if (tolerance > final) break;
      const double whole = norm(values, state, residual);
      if (!std::isfinite(residual)) throw NumericalError("a residual is not a number");
      if (residual <= final) break;
      if (whole <= final) sharper = std::min(sharper, kSharper * whole / residual) * final / tolerance;
      if (pass >= kBegunAnew || (pass > 0 && residual > kNoProgress * before)) {
        run_.atFloor = true;
        break;
      }
      before = residual;
    }
    answer = answerOf(values, states, std::max(final, std::min(tolerance, residual)));
    InterfaceProblem::Evaluation at;
    at.residual = values.residual;
    at.energy = values.energy;
    at.next = state.status;
    at.settled = false;
    for (std::size_t i = 0; i < states.size(); ++i) {
      at.active += states[i].closed() && !sets_.bodies().rigid().isBound(i);
      at.changed += last_.size() == states.size() && last_[i].status != states[i].status;
    }
    last_ = states;
    cost.pcg += applications;
    run_.result.otherApplications += applications;
    run_.accept(std::move(state), std::move(at), residual, cost, 1.0, -1.0);
  } catch (const NumericalError& error) {
    run_.result.failure = error.what();
    answer.solved = false;
  }
  return answer;
}

}  // namespace suture
