#include <Teuchos_UnitTestHarness.hpp>
#include <suture/simulation/moving/Settling.hpp>

using namespace suture;

namespace {

// Quadratic contraction: settled when the next change, the square of the last one, is below a millionth.
TEUCHOS_UNIT_TEST(Settling, EndsBeforeTheChangeThatDoesNotMatter) {
  Settling settling(1.0);
  settling.add(1e-1, 1.0, true);
  TEST_ASSERT(!settling.isSettled());
  settling.add(1e-2, 1.0, true);
  TEST_ASSERT(!settling.isSettled());  // 1e-3 is expected
  settling.add(1e-4, 1.0, true);
  TEST_ASSERT(settling.isSettled());  // 1e-6
}

// Shapes that hardly contract, as in conforming contacts, have not settled because a change is small.
TEUCHOS_UNIT_TEST(Settling, SlowRoundsGoOn) {
  Settling settling(1.0);
  double change = 1e-3;
  int rounds = 0;
  for (; !settling.isSettled() && rounds < 100; change *= 0.5, ++rounds) settling.add(change, 1.0, true);
  TEST_COMPARE(change, <=, 1e-6);
  TEST_COMPARE(change, >, 2e-7);
}

TEUCHOS_UNIT_TEST(Settling, ChangedStatesNeedAnotherRound) {
  Settling settling(1.0);
  settling.add(0.0, 1.0, false);
  TEST_ASSERT(!settling.isSettled());
  settling.add(0.0, 1.0, true);
  TEST_ASSERT(settling.isSettled());
}

TEUCHOS_UNIT_TEST(Settling, BodiesWithoutStrainSettleAtRoundOff) {
  Settling settling(100.0);
  settling.add(1e-12, 0.0, true);
  TEST_ASSERT(settling.isSettled());
}

// Each round is solved more accurately than it changes the shapes, the first one roughly.
TEUCHOS_UNIT_TEST(Settling, ToleranceFollowsTheExpectedChange) {
  Settling settling(1.0);
  const double first = settling.tolerance();
  TEST_COMPARE(first, <=, 1e-3);
  settling.add(1e-1, 1.0, true);
  const double second = settling.tolerance();
  TEST_COMPARE(second, <, 1e-1 * first);
  settling.add(2e-2, 1.0, true);
  TEST_COMPARE(settling.tolerance(), <, second);
  TEST_COMPARE(settling.tolerance(), <=, 1e-3 * 4e-3);  // a small part of the expected change
  TEST_COMPARE(settling.tolerance(), >, 0.0);
}

// The round after which shapes will have settled, as in the step before, is solved to the end: not first roughly and then once more.
TEUCHOS_UNIT_TEST(Settling, TheLastRoundIsSolvedToTheEnd) {
  Settling before(1.0);
  before.add(1e-1, 1.0, true);
  TEST_COMPARE(before.tolerance(), >, 0.0);
  before.add(1e-4, 1.0, true);
  TEST_FLOATING_EQUALITY(before.contraction(), 1e-3, 1e-12);
  Settling settling(1.0, before.contraction());
  TEST_COMPARE(settling.tolerance(), >, 0.0);
  settling.add(1e-1, 1.0, true);
  TEST_ASSERT(!settling.isSettled());  // what was expected is no proof
  TEST_EQUALITY(settling.tolerance(), 0.0);
  settling.add(5e-2, 1.0, true);
  TEST_ASSERT(!settling.isSettled());
  TEST_COMPARE(settling.tolerance(), >, 0.0);
  TEST_FLOATING_EQUALITY(settling.contraction(), 0.5, 1e-12);
}

}  // namespace
