#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/RigidValues.hpp>

namespace suture {
namespace {

TEUCHOS_UNIT_TEST(RigidValues, AreThoseOfAQuarterTurnIn2D) {
  TEST_EQUALITY(rigidMotions(2), 3);
  const Point moved = rigidDisplacement<double>({10, 20, 0}, {0, 0, 1}, {3, 4, 0});
  TEST_ASSERT(moved == (Point{10 - 4, 20 + 3, 0}));
  TEST_ASSERT((rigidValues(2, {3, 4, 0}, {1, 0, 0}) == std::array<double, 6>{1, 0, -4, 0, 0, 0}));
  TEST_ASSERT((rigidValues(2, {3, 4, 0}, {0, 1, 0}, {0, 0, 5}) == std::array<double, 6>{0, 1, 8, 0, 0, 0}));
}

// About the third axis x becomes y and y becomes -x; the other axes follow cyclically.
TEUCHOS_UNIT_TEST(RigidValues, TurnAboutEachAxisInSpace) {
  TEST_EQUALITY(rigidMotions(3), 6);
  const Point arm{2, 3, 5};
  const Point byHand[3] = {{0, -5, 3}, {5, 0, -2}, {-3, 2, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    Point rotation{0, 0, 0};
    rotation[axis] = 1;
    TEST_ASSERT(rigidDisplacement<double>({0, 0, 0}, rotation, arm) == byHand[axis]);
    for (int k = 0; k < 3; ++k) {
      Point direction{0, 0, 0};
      direction[k] = 1;
      const std::array<double, 6> values = rigidValues(3, arm, direction);
      TEST_EQUALITY(values[k], 1.0);
      TEST_EQUALITY(values[3 + axis], byHand[axis][k]);
    }
  }
}

// direction . (t + w x arm) for any direction
TEUCHOS_UNIT_TEST(RigidValues, ArePartsOfTheDisplacement) {
  const double amplitudes[6] = {0.3, -0.7, 1.1, 2.0, -0.4, 0.9};
  const Point arm{0.2, -1.5, 0.8}, direction{0.6, 0.0, -0.8};
  for (const int dimension : {2, 3}) {
    Point translation, rotation, flat = arm;
    if (dimension == 2) flat[2] = 0.0;
    splitAmplitudes(amplitudes, dimension, translation, rotation);
    TEST_ASSERT(rotation == (dimension == 2 ? Point{0, 0, 1.1} : Point{2.0, -0.4, 0.9}));
    const std::array<double, 6> values = rigidValues(dimension, flat, direction);
    double sum = 0.0;
    for (int k = 0; k < 6; ++k) sum += k < rigidMotions(dimension) ? values[k] * amplitudes[k] : values[k];
    TEST_FLOATING_EQUALITY(sum, dot(direction, rigidDisplacement(translation, rotation, flat)), 1e-14);
  }
}

}  // namespace
}  // namespace suture
