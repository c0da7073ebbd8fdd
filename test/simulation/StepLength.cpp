// When pairs change their state, if forces and gaps go on as in the last step: against hand calculations.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/simulation/StepLength.hpp>

#include <cmath>

namespace suture {
namespace {

PairResult pairOf(PairStatus status, double force, Point tangential = {0, 0, 0}, double bound = 0.0, double gap = 0.0) {
  PairResult pair;
  pair.state = status;
  pair.force = force;
  pair.tangential = tangential;
  pair.bound = bound;
  pair.gap = gap;
  return pair;
}

TEUCHOS_UNIT_TEST(StepLength, EndsWhereAPairReachesItsBound) {
  // Normal force 10, friction .3; the tangential force grows by 1 in a step of length 2: it is 3 after two more steps.
  const std::vector<PairResult> before{pairOf(PairStatus::Stick, 10.0, {0, 0, 0}, 3.0)},
      now{pairOf(PairStatus::Stick, 10.0, {1, 0, 0}, 3.0)};
  TEST_FLOATING_EQUALITY(predictedLength(before, now, 2.0, 1), 4.0, 1e-14);
  TEST_ASSERT(std::isinf(predictedLength(before, now, 2.0, 2)));
}

TEUCHOS_UNIT_TEST(StepLength, FollowsAFallingBoundAndATurningForce) {
  // Force (s, 2) and bound 4 - s after a fraction s of a further step: s^2 + 4 = (4 - s)^2.
  const std::vector<PairResult> before{pairOf(PairStatus::Stick, 16.0, {-1, 2, 0}, 5.0)},
      now{pairOf(PairStatus::Stick, 12.0, {0, 2, 0}, 4.0)};
  TEST_FLOATING_EQUALITY(predictedLength(before, now, 1.0, 1), 1.5, 1e-14);
  // A force that falls with its bound, in proportion, slips only when the pair opens.
  const std::vector<PairResult> one{pairOf(PairStatus::Stick, 20.0, {3, 0, 0}, 6.0)},
      other{pairOf(PairStatus::Stick, 10.0, {1.5, 0, 0}, 3.0)};
  TEST_FLOATING_EQUALITY(predictedLength(one, other, 1.0, 1), 1.0, 1e-12);
}

TEUCHOS_UNIT_TEST(StepLength, CountsPairsThatOpenAndClose) {
  const std::vector<PairResult> before{pairOf(PairStatus::Slip, 4.0), pairOf(PairStatus::Open, 0.0, {0, 0, 0}, 0.0, 0.5),
                                       pairOf(PairStatus::Slip, 1.0)},
      now{pairOf(PairStatus::Slip, 3.0), pairOf(PairStatus::Open, 0.0, {0, 0, 0}, 0.0, 0.4), pairOf(PairStatus::Slip, 2.0)};
  TEST_FLOATING_EQUALITY(predictedLength(before, now, 1.0, 1), 3.0, 1e-13);  // the first pair opens
  TEST_FLOATING_EQUALITY(predictedLength(before, now, 1.0, 2), 4.0, 1e-12);  // the second one closes
  TEST_ASSERT(std::isinf(predictedLength(before, now, 1.0, 3)));             // the third one is pressed more and more
}

}  // namespace
}  // namespace suture
