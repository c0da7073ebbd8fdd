#include <Teuchos_UnitTestHarness.hpp>
#include <suture/simulation/moving/Relaxation.hpp>

using namespace suture;

namespace {

/// Steps of the fixed-point iteration x <- factors x in all components until x is below 1e-10; 100 if it does not get there.
int steps(const Vector& factors) {
  Relaxation relaxation;
  Vector x = Vector::Ones(factors.size());
  int count = 0;
  for (; x.norm() > 1e-10 && count < 100; ++count) {
    const Vector change = factors.cwiseProduct(x) - x;
    x += relaxation.factorAfter(change) * change;
  }
  return count;
}

Vector of(double a, double b) {
  Vector both(2);
  both << a, b;
  return both;
}

// What contracts to less than a tenth in a step is left as it is.
TEUCHOS_UNIT_TEST(Relaxation, LeavesQuickStepsAlone) {
  Relaxation relaxation;
  for (double size = 1.0; size > 1e-9; size *= 0.09) TEST_EQUALITY(relaxation.factorAfter(of(size, -size)), 1.0);
}

// A single slow step, as where loads change besides, does not shorten the next one.
TEUCHOS_UNIT_TEST(Relaxation, LeavesASingleSlowStepAlone) {
  Relaxation relaxation;
  TEST_EQUALITY(relaxation.factorAfter(of(1.0, 0.0)), 1.0);
  TEST_EQUALITY(relaxation.factorAfter(of(-0.9, 0.0)), 1.0);
  TEST_EQUALITY(relaxation.factorAfter(of(0.001, 0.0)), 1.0);
}

// Without it, the first of these goes on for ever, the second one diverges; on a line the limit is exact.
TEUCHOS_UNIT_TEST(Relaxation, EndsOscillations) {
  TEST_COMPARE(steps(of(-1.0, -1.0)), <=, 5);
  TEST_COMPARE(steps(of(-1.5, -1.5)), <=, 6);
  TEST_COMPARE(steps(of(-1.0, 0.01)), <=, 12);
  TEST_COMPARE(steps(of(-1.0, 0.5)), <=, 60);
}

// A corner that passes the end of the other side: G has another slope on either side of its fixed point.
TEUCHOS_UNIT_TEST(Relaxation, PassesAKink) {
  Relaxation relaxation;
  Vector x = Vector::Constant(1, 1.0);
  int count = 0;
  for (; x.norm() > 1e-10 && count < 100; ++count) {
    const Vector change = (x[0] > 0.0 ? -1.4 : -0.7) * x - x;
    x += relaxation.factorAfter(change) * change;
  }
  TEST_COMPARE(count, <, 30);
}

}  // namespace
