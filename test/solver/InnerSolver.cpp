// Conjugate gradients that stop and continue perform the same iterations.
#include <suture/base/Timers.hpp>
#include <suture/solver/InnerSolver.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <solver/ContactMethods.hpp>

namespace suture {
namespace {

using namespace blocks;

struct Problem {
  Problem() : one(scene(), world()), linear(one.problem.linearise(one.problem.initialState())), made(preconditioner("BDDC")()) {
    made->initialize(linear.matrix->space());
    made->compute(linear.matrix);
  }
  static Scene scene() {
    Scene scene = clampedSquare(4, 8);
    scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
    return scene;
  }
  InnerResult solve(InnerSolver& solver, MultiVector& x, double tolerance, const EnergyCriterion& criterion = {}) {
    return solver.solve(linear.matrix, made, *linear.load, x, tolerance, 0.0, silent, criterion);
  }

  OnInterface one;
  InterfaceProblem::Linearisation linear;
  Teuchos::RCP<Preconditioner> made;
  Monitor silent;
};

TEUCHOS_UNIT_TEST(InnerSolver, LosesNoIterationWhereItStops) {
  Problem p;
  const MultiVectorPtr whole = p.one.problem.space()->vector(), sum = p.one.problem.space()->vector(),
                       part = p.one.problem.space()->vector();
  InnerSolver solver(200);
  TEST_ASSERT(!solver.canGoOn());
  TEST_THROW(solver.goOn(*part, 1e-10, 0.0, p.silent), InternalError);
  const double begin = Timers::now();
  const long long before = p.made->applications();
  const InnerResult once = p.solve(solver, *whole, 1e-10);
  TEST_EQUALITY(p.made->applications() - before, once.pcg + 1);  // once to the right-hand side
  TEST_COMPARE(once.seconds, >, 0.0);
  TEST_COMPARE(once.seconds, <, Timers::now() - begin);

  InnerResult last = p.solve(solver, *part, 1e-2);
  sum->update(1.0, *part, 0.0);
  int pcg = last.pcg;
  std::vector<double> history = last.history, steps = last.steps;
  for (const double tolerance : {1e-4, 1e-4, 1e-7, 1e-10}) {  // twice the same: nothing remains to be done
    TEST_ASSERT(solver.canGoOn());
    last = solver.goOn(*part, tolerance, 0.0, p.silent);
    TEST_ASSERT(last.converged);
    TEST_EQUALITY(last.history.size(), static_cast<std::size_t>(last.pcg) + 1);
    TEST_EQUALITY(last.history.front(), history.back());
    sum->update(1.0, *part, 1.0);
    pcg += last.pcg;
    history.insert(history.end(), last.history.begin() + 1, last.history.end());
    steps.insert(steps.end(), last.steps.begin(), last.steps.end());
  }
  TEST_EQUALITY(pcg, once.pcg);
  TEST_COMPARE_FLOATING_ARRAYS(history, once.history, 1e-6);
  TEST_COMPARE_FLOATING_ARRAYS(steps, once.steps, 1e-6);
  TEST_FLOATING_EQUALITY(last.condition, once.condition, 1e-6);
  TEST_FLOATING_EQUALITY(last.energyErrors.front(), once.energyErrors.front(), 1e-8);
  const double size = std::sqrt(dot(*whole, *whole));
  sum->update(-1.0, *whole, 1.0);
  TEST_COMPARE(std::sqrt(dot(*sum, *sum)), <, 1e-12 * size);
}

TEUCHOS_UNIT_TEST(InnerSolver, ShowsTheCriterionItsIncrement) {
  Problem p;
  const MultiVectorPtr whole = p.one.problem.space()->vector(), first = p.one.problem.space()->vector(),
                       part = p.one.problem.space()->vector();
  InnerSolver solver(200);
  p.solve(solver, *whole, 1e-12);
  p.solve(solver, *first, 1e-2);
  whole->update(-1.0, *first, 1.0);  // the remainder to add
  const double left = std::sqrt(dot(*whole, *whole));
  double nearest = left;
  EnergyCriterion criterion;
  criterion.enough = [&](double, double, const MultiVector& x) {
    MultiVector error(x, Teuchos::Copy);
    error.update(-1.0, *whole, 1.0);
    nearest = std::sqrt(dot(error, error));
    return nearest < 1e-3 * left;
  };
  const InnerResult result = solver.goOn(*part, 0.0, 0.0, p.silent, criterion);
  TEST_ASSERT(result.enough && result.converged);
  part->update(-1.0, *whole, 1.0);
  TEST_EQUALITY(std::sqrt(dot(*part, *part)), nearest);
}

TEUCHOS_UNIT_TEST(InnerSolver, DoesNotGoOnForEver) {
  Problem p;
  const MultiVectorPtr x = p.one.problem.space()->vector();
  InnerSolver solver(3);
  const InnerResult some = p.solve(solver, *x, 1e-12);
  TEST_EQUALITY(some.pcg, 3);
  TEST_ASSERT(solver.canGoOn());
  const InnerResult more = solver.goOn(*x, 1e-12, 0.0, p.silent);
  TEST_EQUALITY(more.pcg, 3);
  TEST_ASSERT(!more.converged && !solver.canGoOn());
}

// Without a tolerance the recurrence would go on to underflow, and break down there.
TEUCHOS_UNIT_TEST(InnerSolver, EndsAtRoundOff) {
  Problem p;
  const MultiVectorPtr x = p.one.problem.space()->vector(), exact = p.one.problem.space()->vector();
  InnerSolver solver(2000);
  const InnerResult once = p.solve(solver, *exact, 1e-14), result = p.solve(solver, *x, 0.0);
  TEST_ASSERT(result.converged);
  TEST_COMPARE(result.residual, <=, 2.3e-16);
  TEST_COMPARE(result.pcg, <, once.pcg + 10);
  const double size = std::sqrt(dot(*exact, *exact));
  x->update(-1.0, *exact, 1.0);
  TEST_COMPARE(std::sqrt(dot(*x, *x)), <, 1e-12 * size);
}

}  // namespace
}  // namespace suture
