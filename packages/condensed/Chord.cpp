#include <suture/condensed/Anderson.hpp>
#include <suture/condensed/Chord.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

Schema Chord::schema() {
  Schema schema("Fixed matrix with all pairs closed; the energy decreases in every step.");
  schema.real("Inner Tolerance", 1e-2, "Tolerance of each linear solve, relative to the outer residual at its start.",
              {0.0, 1.0, true, true, {}});
  schema.integer("Anderson Depth", 5, "Number of corrections combined by Anderson acceleration; 0: none.",
                 Range{0.0, 100.0, false, false, {}});
  return schema;
}

Chord::Chord(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")), depth_(own.get<int>("Anderson Depth")) {}

void Chord::doSolve(Run& run) const {
  Anderson anderson(depth_);
  const MultiVectorPtr correction = run.problem.space()->vector();
  while (run.goesOn()) {
    InnerResult cost =
        run.inner.solve(run.bilateral, run.preconditioner, *run.evaluation.residual, *correction, innerTolerance_, 0.0, run.monitor);
    run.learn(cost);
    if (!cost.converged) {
      run.result.pcgTotal += cost.pcg;
      run.result.failure = "a linear solve did not reach its tolerance";
      return;
    }
    const double rounding = 1e-12 * std::abs(run.evaluation.energy);
    MultiVectorPtr step = anderson.accelerate(*run.result.state.trace, *correction, *run.evaluation.residual);
    for (bool plain = step.is_null();; plain = true) {
      InterfaceState next = run.result.state;
      next.trace = Teuchos::rcp(new MultiVector(*run.result.state.trace, Teuchos::Copy));
      run.problem.update(next, plain ? *correction : *step, 1.0);
      InterfaceProblem::Evaluation at = run.problem.evaluate(next);
      if (!plain && at.energy > run.evaluation.energy + rounding) {
        anderson.restart();
        continue;
      }
      const double residual = run.norm(at);
      const double energyError = run.energyErrorByTangent(next, at, residual, cost);
      run.accept(std::move(next), std::move(at), residual, cost, 1.0, energyError);
      break;
    }
  }
}

namespace {
const Registration<OuterSolver> registrationChord("Chord", Chord::schema(),
                                                  [](const Parameters& own) { return std::make_unique<Chord>(own); });
}  // namespace

}  // namespace suture
