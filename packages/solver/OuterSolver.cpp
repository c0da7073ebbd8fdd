#include <suture/base/Timers.hpp>
#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace suture {

namespace {
constexpr double kTangentTolerance = 0.1;

double euclidean(const MultiVector& x) { return std::sqrt(dot(x, x)); }

/// Moves the lifted start of a linear problem along the line to an earlier solution, to the minimum of the energy. For proportionally
/// scaled loads this is the solution. Returns the residual there. Applies the operator once. \param lifted  linearisation at the state
MultiVectorPtr startOnTheWayTo(const InterfaceState& earlier, const InterfaceProblem& problem,
                               const InterfaceProblem::Linearisation& lifted, InterfaceState& state) {
  const MultiVectorPtr way = problem.space()->vector(), image = problem.space()->vector(), residual = problem.space()->vector();
  way->update(1.0, *earlier.trace, -1.0, *state.trace, 0.0);
  lifted.matrix->apply(*way, *image);
  const double twice = dot(*way, *image), length = twice > 0.0 ? dot(*way, *lifted.load) / twice : 0.0;
  problem.update(state, *way, length);
  residual->update(1.0, *lifted.load, -length, *image, 0.0);
  return residual;
}

std::map<std::string, int> chosenSchur(const InterfaceOperator& matrix) {
  std::map<std::string, int> counts;
  for (const std::string name : {"Explicit", "Implicit"}) {
    const int mine = static_cast<int>(std::count_if(matrix.locals().begin(), matrix.locals().end(),
                                                    [&](const auto& local) { return local && local->chosenSchur() == name; }));
    int all = 0;
    Teuchos::reduceAll(*matrix.space()->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
    if (all > 0) counts[name] = all;
  }
  return counts;
}

}  // namespace

double OuterSolver::Run::norm(const InterfaceProblem::Evaluation& at) const {
  return reference > 0.0 ? preconditionedNorm(*preconditioner, *at.residual) / reference : 0.0;
}

bool OuterSolver::Run::done() const {
  if (!evaluation.settled) return false;
  if (result.residual <= settings.tolerance) return true;
  if (bySets) return automatic.sure() && result.residual <= automatic.tolerance();
  return evaluation.changed == 0 && automatic.met(result.energyError);
}

void OuterSolver::Run::learn(const InnerResult& solve) {
  if (solve.smallestEigenvalue > 0.0) lowest = lowest > 0.0 ? std::min(lowest, solve.smallestEigenvalue) : solve.smallestEigenvalue;
  if (lowest > 0.0) automatic.learn(result.lowestEigenvalue = lowest);
}

double OuterSolver::Run::energyErrorByTangent(const InterfaceState& state, const InterfaceProblem::Evaluation& at, double residual,
                                              InnerResult& cost) {
  // Tangents are softer than the operators of these methods, so the error is larger than this bound.
  if (!automatic.within(energyBound(residual)) || at.changed > 0) return -1.0;
  InterfaceState there = state;
  there.status = at.next;
  try {
    const MultiVectorPtr error = problem.space()->vector();
    const InnerResult solve =
        inner.solve(problem.linearise(there).matrix, preconditioner, *at.residual, *error, kTangentTolerance, 0.0, monitor);
    cost.pcg += solve.pcg;
    return solve.converged && !solve.energyErrors.empty() ? solve.energyErrors.front() : -1.0;
  } catch (const NumericalError&) {
    return -1.0;  // singular tangent: the position of loose parts is arbitrary
  }
}

void OuterSolver::Run::accept(InterfaceState state, InterfaceProblem::Evaluation at, double residual, const InnerResult& cost, double step,
                              double energyError) {
  OuterRow row;
  row.iteration = ++result.iterations;
  row.pcg = cost.pcg;
  row.condition = cost.condition;
  row.residual = residual;
  row.euclidean = referenceEuclidean > 0.0 ? euclidean(*at.residual) / referenceEuclidean : 0.0;
  row.active = at.active;
  row.changed = static_cast<int>(problem.differing(reported, at.next).size());
  row.energy = at.energy;
  row.step = step;
  row.seconds = Timers::now() - begin;
  row.energyError = energyError;
  monitor.outer(row);
  reported = at.next;

  result.pcgTotal += cost.pcg;
  result.residual = residual;
  result.energyError = energyError;
  result.state = std::move(state);
  result.state.status = at.next;
  evaluation = std::move(at);
  confirm();
  if (!done() && settings.accepted) settings.accepted(result.state);
}

void OuterSolver::Run::confirm() {
  AutomaticTolerance::Recovered recovered = automatic.takeRecovered();
  result.discretisation.reset();
  result.recovered.reset();
  if (evaluation.changed > 0) automatic.statusChanged();
  // With friction only the search knows whether the states are settled.
  const bool isSettled = evaluation.settled || (bySets && problem.contact()->laws().restrictSliding());
  const auto isAccurate = [&] { return bySets ? result.residual <= tolerance() : automatic.within(result.energyError); };
  if (!automatic.on() || !isSettled || evaluation.changed > 0 || result.residual <= settings.tolerance || !isAccurate()) return;
  if (!automatic.sure()) {
    automatic.estimate(result.state, std::max(result.energyError, 0.0));
    recovered = automatic.takeRecovered();
  }
  if (!automatic.sure() || !isAccurate()) return;
  result.discretisation = automatic.last();
  result.recovered = std::move(recovered);
}

std::string OuterSolver::Run::reason() const {
  std::ostringstream text;
  text.precision(2);
  text << std::scientific << "automatic tolerance: the algebraic error ";
  if (result.energyError >= 0.0) text << result.energyError << " ";
  text << "is below a tenth of the estimated discretisation error " << automatic.last()->energyNorm << " (energy norm; estimated "
       << automatic.estimates() << (automatic.estimates() == 1 ? " time" : " times") << "), at a residual of " << result.residual;
  return text.str();
}

bool OuterSolver::Run::stopRequested() {
  const int mine = monitor.stopRequested();
  int any = 0;
  Teuchos::reduceAll(*problem.space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return result.stopped = any != 0;
}

bool OuterSolver::Run::goesOn() { return !done() && !stopRequested() && result.iterations < settings.maximumIterations; }

void OuterSolver::Run::describe(const InterfaceOperator& matrix) {
  if (std::exchange(described, true)) return;
  result.coarseSize = preconditioner->coarseSize();
  if (const std::string remark = preconditioner->remark(); !remark.empty()) monitor.note(remark);
  result.setupSeconds = preconditioner->setupSeconds();
  result.bytesRead = preconditioner->bytesRead() + matrix.bytesRead();
  result.chosenSchur = chosenSchur(matrix);
  if (const auto implicit = result.chosenSchur.find("Implicit"); implicit != result.chosenSchur.end())
    monitor.note("Schur complements, chosen automatically: " + std::to_string(result.chosenSchur["Explicit"]) + " explicit, " +
                 std::to_string(implicit->second) + " implicit");
}

OuterResult OuterSolver::conclude(Run& run) {
  OuterResult& result = run.result;
  result.converged = run.done() || run.solved;
  if (!run.preconditioner.is_null()) result.coarseSize = run.preconditioner->coarseSize();  // it changes with the sets
  if (result.converged && result.discretisation) run.monitor.note(run.reason());
  if (result.stopped && !result.converged && result.failure.empty()) result.failure = "stopped on request";
  if (!result.converged && result.failure.empty())
    result.failure =
        "the tolerance was not reached within " + std::to_string(result.iterations) + " outer iterations" +
        (result.iterations < run.settings.maximumIterations ? ", fewer than allowed: there were no more contact states to try" : "");
  return std::move(result);
}

OuterResult OuterSolver::solve(const InterfaceProblem& problem, const OuterSettings& settings, Monitor& monitor,
                               const InterfaceState* given) const {
  OuterResult result;
  Run run{problem,
          settings,
          monitor,
          InnerSolver(settings.maximumInnerIterations),
          {},
          {},
          0.0,
          0.0,
          Timers::now(),
          result,
          {},
          {},
          AutomaticTolerance(problem, settings.discretisationError)};
  const bool contact = problem.pairs() > 0;
  const bool bySets = contact && worksBySets() && problem.contact() != nullptr;
  const bool restricts = contact && problem.contact() && problem.contact()->laws().restrictSliding();
  if (restricts && !bySets)
    throw InputError(
        "Outer Solver/Type",
        "the method does not support friction, which a Law of this scene has; expected 'Active Set', or 'Semismooth Newton' with Condensed "
        "Groups");
  const bool startsItself = bySets && (given || settings.rigidStart || !wantsAuxiliary());
  result.state = given && contact                                    ? *given
                 : startsItself && settings.rigidStart && !restricts ? problem.contact()->padState()
                                                                     : problem.initialState();
  run.reported = result.state.status;
  run.given = given != nullptr;
  const int lifting = result.state.applications;
  if (problem.space()->size() == 0 && !restricts) {  // one subdomain per body: the local problems are the whole problem
    result.converged = true;
    return result;
  }

  run.preconditioner = settings.preconditioner();
  run.bySets = bySets;
  if (startsItself) {
    result.auxiliary.contact = true;
    run.evaluation.settled = false;  // not evaluated yet
    doSolve(run);
    return conclude(run);
  }
  const InterfaceProblem::Linearisation start = problem.linearise(given && contact ? problem.initialState() : result.state);
  run.bilateral = start.matrix;
  run.preconditioner->initialize(start.matrix->space());
  run.preconditioner->compute(start.matrix);
  run.describe(*start.matrix);
  run.reference = preconditionedNorm(*run.preconditioner, *start.load);
  run.referenceEuclidean = euclidean(*start.load);
  run.automatic.startsFrom(run.reference);

  if (given && contact) {
    result.auxiliary.contact = contact;
  } else {
    const double tolerance = contact ? auxiliaryTolerance(settings) : settings.tolerance;
    const MultiVectorPtr step = problem.space()->vector();
    const bool continues = given && run.reference > 0.0;
    const MultiVectorPtr load = continues ? startOnTheWayTo(*given, problem, start, result.state) : start.load;
    start.matrix->record();
    const InnerResult auxiliary =
        run.inner.solve(start.matrix, run.preconditioner, *load, *step, tolerance, continues ? run.reference : 0.0, monitor,
                        run.automatic.criterion(result.state, 0.0, !continues, !contact));
    run.learn(auxiliary);
    const Matrix image = start.matrix->recorded(auxiliary.steps);
    problem.update(result.state, *step, 1.0, &image);
    result.auxiliary = {auxiliary.pcg + lifting + continues, auxiliary.condition, tolerance, auxiliary.residual, contact};
    if (auxiliary.pcg > 0) result.auxiliary.iterationSeconds = auxiliary.seconds / auxiliary.pcg;
    if (!auxiliary.energyErrors.empty()) result.energyError = result.auxiliary.energyError = auxiliary.energyErrors.back();
    monitor.auxiliary(result.auxiliary);
    result.residual = auxiliary.residual;
    if (!auxiliary.converged) {
      result.failure =
          "the auxiliary problem did not reach its tolerance within " + std::to_string(settings.maximumInnerIterations) + " iterations";
      return result;
    }
    if (!contact) {  // linear: this is the solution
      result.converged = true;
      if (auxiliary.enough) {
        monitor.note(run.reason());
        result.discretisation = run.automatic.last();
        result.recovered = run.automatic.takeRecovered();
      }
      return result;
    }
  }

  if (bySets) {
    run.fromAuxiliary = true;
    run.preconditioned = result.state.status;
    if (const PairStates next = problem.contact()->proposal(result.state); !next.empty())
      result.state.status = problem.contact()->statusOf(next);
    run.evaluation.settled = false;
    doSolve(run);
    return conclude(run);
  }
  run.evaluation = problem.evaluate(result.state, 10.0 * settings.tolerance);
  result.pcgTotal += run.evaluation.applications;
  result.otherApplications += run.evaluation.applications;
  result.residual = run.norm(run.evaluation);
  result.state.status = run.evaluation.next;
  // The error of the auxiliary solution remains valid as long as all pairs stay closed.
  if (run.evaluation.changed > 0 || given) result.energyError = run.energyBound(result.residual);
  run.confirm();
  if (!run.done()) doSolve(run);
  return conclude(run);
}

void registerBuiltIns(Registry<OuterSolver>& registry) {
  registry.add("Active Set", ActiveSet::schema(), [](const Parameters& own) { return std::make_unique<ActiveSet>(own); });
}

}  // namespace suture
