// States of contact pairs kept from one set of pairs to the next.
#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/simulation/moving/KeptStates.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <cmath>

namespace {

using namespace suture;

ContactPair pairAt(int node, const Point& normal) {
  ContactPair pair;
  pair.line = 0;
  pair.ends = {{node, 1.0}};
  pair.normal = normal;
  return pair;
}

Point inSpace(const ContactPair& pair, const ContactState& state, int dimension) {
  const std::vector<Point> frame = pairFrame(pair, dimension);
  Point direction{0, 0, 0};
  for (std::size_t k = 1; k < frame.size(); ++k) direction = plus(direction, scaled(state.direction[k], frame[k]));
  return direction;
}

}  // namespace

// The tangents of these two normals, an angle of 1e-5 apart, differ by a right angle.
TEUCHOS_UNIT_TEST(KeptStates, DirectionStaysInSpaceWhenTheFrameTurns) {
  const ContactPair before = pairAt(7, unit({0, 1e-5, 1})), after = pairAt(7, unit({1e-5, 0, 1}));
  TEST_COMPARE(std::abs(dot(pairFrame(before, 3)[1], pairFrame(after, 3)[1])), <, 0.1);
  KeptStates states(3);
  states.keep(before, ContactState(PairStatus::Slip, {0, 0.6, -0.8}, 2.0, 0.3));
  const ContactState now = states.of(after);
  TEST_COMPARE(norm(minus(inSpace(after, now, 3), inSpace(before, {PairStatus::Slip, {0, 0.6, -0.8}, 2.0}, 3))), <, 2e-5);
  TEST_FLOATING_EQUALITY(std::hypot(now.direction[1], now.direction[2]), 1.0, 1e-14);
  TEST_EQUALITY(now.bound, 2.0);
  TEST_EQUALITY(now.friction, 0.3);
}

// A body that turns by more than a right angle in a step: in 2D the sense of sliding along the tangent remains.
TEUCHOS_UNIT_TEST(KeptStates, DirectionTurnsWithTheNormal) {
  KeptStates flat(2);
  flat.keep(pairAt(3, {0, -1, 0}), ContactState(PairStatus::Slip, {0, -1, 0}, 1.0));
  TEST_FLOATING_EQUALITY(flat.of(pairAt(3, {std::cos(2.0), std::sin(2.0), 0})).direction[1], -1.0, 1e-14);
  // In space about z by 2: a direction along z remains, one across turns along.
  KeptStates solid(3);
  const ContactPair before = pairAt(3, {1, 0, 0}), after = pairAt(3, {std::cos(2.0), std::sin(2.0), 0});
  for (const Point& direction : {Point{0, 0, 1}, Point{0, 1, 0}}) {
    ContactState state(PairStatus::Slip);
    for (int k = 1; k <= 2; ++k) state.direction[k] = dot(direction, pairFrame(before, 3)[k]);
    solid.keep(before, state);
    const Point expected = direction[2] > 0 ? direction : Point{-std::sin(2.0), std::cos(2.0), 0};
    TEST_COMPARE(norm(minus(inSpace(after, solid.of(after), 3), expected)), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(KeptStates, OtherPairsAreOpen) {
  KeptStates states(3);
  TEST_ASSERT(!states.anyClosed());
  const ContactPair known = pairAt(3, {0, 0, 1});
  states.keep(known, PairStatus::Open);
  TEST_ASSERT(states.contains(known) && !states.anyClosed());
  states.keep(known, PairStatus::Stick);
  TEST_ASSERT(states.anyClosed() && states.statusOf(known) == PairStatus::Stick);
  ContactPair other = known;
  other.line = 1;
  TEST_ASSERT(!states.contains(other) && states.statusOf(other) == PairStatus::Open && !states.of(other).closed());
}
