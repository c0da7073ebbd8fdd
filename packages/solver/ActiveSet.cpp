#include <suture/solver/ActiveSet.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

bool VisitedSets::returnsTo(const ContactStatus& set) {
  for (first_ = 0; first_ < sets_.size(); ++first_)
    if (problem_.differing(sets_[first_], set).empty()) return true;
  sets_.push_back(set);
  return false;
}

std::vector<int> VisitedSets::alternating() const {
  std::vector<int> all;
  for (std::size_t k = first_; k + 1 < sets_.size(); ++k) {
    const std::vector<int> changed = problem_.differing(sets_[k], sets_[k + 1]);
    all.insert(all.end(), changed.begin(), changed.end());
  }
  const std::vector<int> back = problem_.differing(sets_.back(), sets_[first_]);
  all.insert(all.end(), back.begin(), back.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace {
constexpr double kTighten = 1e-2;

std::string listOf(const std::vector<int>& pairs) {
  std::string text;
  for (std::size_t k = 0; k < pairs.size() && k < 20; ++k) text += (k > 0 ? ", " : "") + std::to_string(pairs[k]);
  if (pairs.size() > 20) text += ", and " + std::to_string(pairs.size() - 20) + " more";
  return text;
}
}  // namespace

Schema ActiveSet::schema() {
  Schema schema("Primal-dual active set on the interface (Contact On The Interface).");
  schema.real("Inner Tolerance", 1e-3, "Of linear solves until the set of closed pairs stays, relative to the residual of the start.",
              {0.0, 1.0, true, true, {}});
  return schema;
}

ActiveSet::ActiveSet(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")) {}

double ActiveSet::auxiliaryTolerance(const OuterSettings& settings) const { return std::max(innerTolerance_, settings.tolerance); }

void ActiveSet::doSolve(Run& run) const {
  const double final = run.settings.tolerance;
  double inner = std::max(innerTolerance_, final);
  const double between = std::sqrt(inner * final);
  bool loosened = false;
  const MultiVectorPtr step = run.problem.space()->vector();
  VisitedSets visited(run.problem);
  bool stays = run.evaluation.settled;
  ContactStatus preconditioned = run.reported;  // the set that the preconditioner was made for: at first all closed
  Teuchos::RCP<InterfaceOperator> matrix = run.bilateral;
  bool drifted = false;  // the recursion of conjugate gradients had lost the residual
  while (run.goesOn()) {
    InterfaceState state = run.result.state;
    state.trace = Teuchos::rcp(new MultiVector(*run.result.state.trace, Teuchos::Copy));
    if (!stays && visited.returnsTo(state.status)) {
      if (inner <= final) {
        run.result.failure =
            "the set of closed pairs repeats itself at the final tolerance; pairs that alternate: " + listOf(visited.alternating());
        return;
      }
      inner = std::max(kTighten * inner, final);
      run.automatic.tighten();
      visited.clear();
    }
    // Half way first: the set may move once more, and conjugate gradients lose nothing by being asked in between. Not where a solution is
    // gone on from.
    const bool begun = run.result.iterations > 0 || run.inner.canGoOn();
    if (stays) inner = inner > between && begun ? between : final;
    const EnergyCriterion criterion = run.automatic.criterion(state, run.lowest, false, stays);
    int applications = 0;
    InnerResult cost;
    if (stays && !drifted && run.inner.canGoOn()) {  // the same linear problem, and what was learnt of it
      matrix->record();
      cost = run.inner.goOn(*step, inner, run.reference, run.monitor, criterion);
    } else {
      applications = run.problem.conform(state);
      const InterfaceProblem::Linearisation linear = run.problem.linearise(state);
      matrix = linear.matrix;
      if (!run.problem.differing(preconditioned, state.status).empty()) {
        run.preconditioner->initialize(matrix->space());
        run.preconditioner->compute(matrix);
        preconditioned = state.status;
      }
      matrix->record();
      cost = run.inner.solve(matrix, run.preconditioner, *linear.load, *step, inner, run.reference, run.monitor, criterion);
    }
    run.learn(cost);
    const Matrix image = matrix->recorded(cost.steps);
    if (!cost.converged) {
      run.result.pcgTotal += cost.pcg + applications;
      run.result.failure = "a linear solve did not reach its tolerance";
      return;
    }
    run.problem.update(state, *step, 1.0, &image);
    InterfaceProblem::Evaluation at = run.problem.evaluate(state, 10.0 * final);
    double residual = cost.residual;
    if (at.settled && residual <= final) {  // what the recursion of conjugate gradients says, confirmed by the operator itself
      state.memory.reset();
      at = run.problem.evaluate(state, 10.0 * final);
      residual = run.norm(at);
      drifted = residual > final;
    }
    applications += at.applications;
    if (!std::isfinite(residual)) throw NumericalError("the active set met a residual that is no number");
    cost.pcg += applications;
    // A set that moves by a pair or two after a final solve may do so again: half way there is enough to see it. Once: this must end.
    if (stays && !at.settled && inner <= final && !loosened) {
      loosened = true;
      inner = between;
    }
    stays = at.settled;
    run.accept(std::move(state), std::move(at), residual, cost, 1.0, cost.energyErrors.empty() ? -1.0 : cost.energyErrors.back());
  }
}

}  // namespace suture
