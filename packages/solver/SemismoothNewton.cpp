#include <suture/solver/SemismoothNewton.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr double kDrift = 2.0;  // residual, by what the recursion of conjugate gradients says, with which they may be gone on with
}

Schema SemismoothNewton::schema() {
  Schema schema("Newton's method on the condensed contact problem.");
  schema.real("Inner Tolerance", 1e-2, "Of each linear solve, relative to the outer residual that it starts from.",
              {0.0, 1.0, true, true, {}});
  return schema;
}

SemismoothNewton::SemismoothNewton(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")) {}

void SemismoothNewton::doSolve(Run& run) const {
  const MultiVectorPtr step = run.problem.space()->vector();
  bool same = run.evaluation.changed == 0;  // the tangent is the matrix of the last linear solve, the residual what that has left
  while (run.goesOn()) {
    // No more digits than the end asks for.
    const double tolerance = std::max(innerTolerance_, std::min(0.1, 0.2 * run.settings.tolerance / run.result.residual));
    const EnergyCriterion criterion = run.automatic.criterion(run.result.state, run.lowest, false, false);
    InnerResult cost;
    if (same && run.inner.canGoOn()) {
      cost = run.inner.goOn(*step, tolerance, run.result.residual * run.reference, run.monitor, criterion);
    } else {
      Teuchos::RCP<InterfaceOperator> tangent;
      try {
        tangent = run.problem.linearise(run.result.state).matrix;
      } catch (const NumericalError& singular) {
        run.monitor.note(std::string("the tangent is singular, a chord step is taken: ") + singular.what());
        tangent = run.bilateral;
      }
      cost = run.inner.solve(tangent, run.preconditioner, *run.evaluation.residual, *step, tolerance, 0.0, run.monitor, criterion);
    }
    run.learn(cost);
    if (!cost.converged) {
      run.result.pcgTotal += cost.pcg;
      run.result.failure = "a linear solve did not reach its tolerance";
      return;
    }

    double length = 1.0;
    InterfaceState next;
    InterfaceProblem::Evaluation at;
    double residual = 0.0;
    for (;; length *= 0.5) {
      next = run.result.state;
      next.trace = Teuchos::rcp(new MultiVector(*run.result.state.trace, Teuchos::Copy));
      run.problem.update(next, *step, length);
      at = run.problem.evaluate(next);
      residual = run.norm(at);
      const double rounding = 1e-12 * std::abs(run.evaluation.energy);
      if (!std::isfinite(residual)) throw NumericalError("Newton's method met a residual that is no number");
      if (residual <= run.result.residual || at.energy <= run.evaluation.energy + rounding || length < 1e-3) break;
    }
    // A full step that changes no pair leaves what the linear solve left.
    const bool linear = at.changed == 0 && length == 1.0;
    same = linear && residual <= kDrift * cost.residual * run.result.residual;
    run.accept(std::move(next), std::move(at), residual, cost, length,
               linear && !cost.energyErrors.empty() ? cost.energyErrors.back() : run.energyBound(residual));
  }
}

}  // namespace suture
