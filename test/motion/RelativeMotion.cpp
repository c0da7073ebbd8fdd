// Motion of two bodies against each other in a step, against kinematics in closed form.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/motion/RelativeMotion.hpp>

#include <cmath>

namespace suture {
namespace {

/// A node of a body that is moved by a shift and a rotation vector about the centre of its frame. \param drawn  its place there
MovedNodes moved(const BodyFrame& from, const Point& shift, const Point& rotation, const Point& drawn, double weight) {
  MovedNodes nodes;
  nodes.from = nodes.to = from;
  nodes.to.move(shift, rotation, from.place());
  nodes.add(weight, drawn, drawn);
  return nodes;
}

MovedNodes resting(const Point& place) { return moved(BodyFrame(), {0, 0, 0}, {0, 0, 0}, place, -1.0); }

const Point kDown{0, -1, 0};

// A block falls by 3 through a gap of 1 and moves sideways by 0.6.
TEUCHOS_UNIT_TEST(RelativeMotion, LandsWhereItsGapCloses) {
  const MovedNodes block = moved(BodyFrame({0, 5, 0}), {0.6, -3, 0}, {0, 0, 0}, {0.2, 4, 0}, 1.0);
  for (const MovedNodes& ground : {resting({0.8, 3, 0}), MovedNodes()}) {
    const RelativeMotion motion(block, ground);
    TEST_FLOATING_EQUALITY(motion.closing(kDown, -2.0), 1.0 / 3, 1e-10);
    TEST_FLOATING_EQUALITY(motion.closing(kDown, 0.1), 1.0 - 1e-3, 1e-10);  // stays open
    TEST_EQUALITY(motion.closing(kDown, -3.5), 0.0);                        // was closed
    for (const double part : {0.0, 1.0 / 3, 0.9}) {                         // uniform: as long as in the whole step
      const Point slip = motion.slipAfter(part, kDown);
      TEST_FLOATING_EQUALITY(slip[0], 0.6, 1e-12);
      TEST_COMPARE(std::abs(slip[1]), <, 1e-14);
    }
  }
}

// A roller of radius R turns by 0.8 and moves by 0.8 R: a point of its rim moves along a cycloid, R (phi - sin phi) sideways and
// R (1 - cos phi) up. The point is lowest after 0.6 of the step, where it is pressed in by 0.02.
TEUCHOS_UNIT_TEST(RelativeMotion, RollsWithoutSlipNearTheContact) {
  const double radius = 10.0, angle = 0.8, lowest = 0.6, depth = 0.02;
  const auto phi = [&](double part) { return angle * (part - lowest); };
  const BodyFrame hub({3, radius, 0});
  // Turned clockwise; at the beginning the point is ahead of the lowest one.
  const Point rim{3 + radius * std::sin(angle * lowest), radius - radius * std::cos(angle * lowest), 0};
  const MovedNodes roller = moved(hub, {radius * angle, 0, 0}, {0, 0, -angle}, rim, 1.0);
  const RelativeMotion motion(roller, resting({0, 0, 0}));
  const auto height = [&](double part) { return radius * (1.0 - std::cos(phi(part))) - depth; };
  const double closes = lowest - std::acos(1.0 - depth / radius) / angle;
  TEST_FLOATING_EQUALITY(motion.closing(kDown, height(1.0)), closes, 1e-9);
  for (const double part : {0.0, closes, 0.9}) {
    const auto way = [&](double at) { return radius * (phi(at) - std::sin(phi(at))); };
    TEST_COMPARE(std::abs(motion.slipAfter(part, kDown)[0] - (way(1.0) - way(part)) / (1.0 - part)), <, 1e-11);
  }
}

// Bodies that move together, turning by more than half a turn, do not move against each other.
TEUCHOS_UNIT_TEST(RelativeMotion, OfBodiesThatMoveTogetherIsZero) {
  const Point turn{0.5, -1.5, 2.0}, shift{4, 5, -6}, about{1, 2, 3};
  const auto together = [&](const Point& centre, const Point& drawn, double weight) {
    MovedNodes nodes;
    nodes.from = nodes.to = BodyFrame(centre);
    nodes.to.move(shift, turn, about);
    nodes.add(weight, drawn, drawn);
    return nodes;
  };
  const RelativeMotion motion(together({1, 0, 0}, {2, 1, 0.5}, 1.0), together({5, -3, 2}, {2.5, 1, 0.5}, -1.0));
  for (const double part : {0.0, 0.3, 0.8}) {
    TEST_COMPARE(norm(minus(motion.at(part), motion.at(1.0))), <, 1e-13);
    TEST_COMPARE(norm(motion.slipAfter(part, {0, 0, 1})), <, 1e-12);
  }
}

// Strains grow in proportion: a node that is pushed in by 0.3 and aside by 0.1 while its body rests.
TEUCHOS_UNIT_TEST(RelativeMotion, StrainsChangeInProportion) {
  MovedNodes node;
  node.add(1.0, {0, 0.1, 0}, {0.1, -0.2, 0});
  const RelativeMotion motion(node, resting({0, 0, 0}));
  TEST_FLOATING_EQUALITY(motion.closing(kDown, -0.2), 1.0 / 3, 1e-10);
  TEST_FLOATING_EQUALITY(motion.slipAfter(0.5, kDown)[0], 0.1, 1e-12);
}

}  // namespace
}  // namespace suture
