#include <suture/search/SoftBodies.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace suture {
namespace {

/// A plate of half-length 1 on pads at x = -1, 0 and 1; it moves down (first motion) and turns (second motion).
RigidBodyModel::Pairs plate(double weight, double moment) {
  RigidBodyModel::Pairs pairs;
  pairs.rows = (Matrix(3, 2) << 1.0, -1.0, 1.0, 0.0, 1.0, 1.0).finished().sparseView();
  pairs.work = Vector(2);
  pairs.work << weight, moment;
  pairs.penetration = Vector::Zero(3);
  pairs.stiffness = Vector::Constant(3, 2.0);
  pairs.line.assign(3, 0);
  pairs.bodies.assign(3, {0, 1});
  pairs.canChange.assign(3, 1);
  return pairs;
}

// With only the middle pad in reach, the spring carries the moment: turn = moment / spring, and the pad carries the weight.
TEUCHOS_UNIT_TEST(SoftBodies, ASpringCarriesWhatPadsCannot) {
  const double spring = 1e-3, weight = 2.0, moment = 0.5;
  Vector springs(2), t(3), reached;
  springs << 0.0, spring;
  t << -1e4, 0.0, -1e4;
  const SoftBodies bodies(plate(weight, moment), springs);
  const RigidBodyModel::Equilibrium found = bodies.project(t, Vector::Constant(3, 0.25), reached);
  TEST_ASSERT(found.found);
  TEST_FLOATING_EQUALITY(found.motion(1), moment / spring, 1e-10);
  TEST_FLOATING_EQUALITY(found.motion(0), 0.25 * weight, 1e-10);
  TEST_FLOATING_EQUALITY(found.force(1), weight, 1e-10);
  TEST_EQUALITY(found.force(0), 0.0);
  TEST_FLOATING_EQUALITY(reached(1), 0.25 * weight, 1e-10);
  TEST_FLOATING_EQUALITY(reached(2), -1e4 + 0.25 * weight + moment / spring, 1e-10);
}

// Beside pads in reach it carries next to nothing: statics of the two outer pads.
TEUCHOS_UNIT_TEST(SoftBodies, PadsCarryWhatTheyCan) {
  Vector springs(2), t(3), reached;
  springs << 0.0, 1e-6;
  t << 0.0, -1.0, 0.0;
  const SoftBodies bodies(plate(2.0, 0.5), springs);
  const RigidBodyModel::Equilibrium found = bodies.project(t, Vector::Constant(3, 0.25), reached);
  TEST_ASSERT(found.found);
  TEST_FLOATING_EQUALITY(found.force(0), 0.75, 1e-5);
  TEST_FLOATING_EQUALITY(found.force(2), 1.25, 1e-5);
  PairStates middle(3), outer(3);
  middle[1] = outer[0] = outer[2] = PairStatus::Slip;
  TEST_ASSERT(bodies.loosens(middle));
  TEST_ASSERT(!bodies.loosens(outer));
}

}  // namespace
}  // namespace suture
