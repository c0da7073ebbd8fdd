#include <suture/base/Point.hpp>
#include <suture/motion/BodyFrame.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <cmath>

using namespace suture;

namespace {

constexpr double kPi = 3.14159265358979323846;

bool isNear(const Point& a, const Point& b, double tolerance) { return norm(minus(a, b)) <= tolerance; }

TEUCHOS_UNIT_TEST(BodyFrame, TurnsAboutAPointOfSpace) {
  BodyFrame frame({1, 0, 0});
  frame.move({0, 0, 0}, {0, 0, kPi / 2}, {0, 0, 0});
  TEST_ASSERT(isNear(frame.at({1, 0, 0}), {0, 1, 0}, 1e-15));
  TEST_ASSERT(isNear(frame.at({2, 0, 0}), {0, 2, 0}, 1e-15));
  TEST_ASSERT(isNear(frame.turn({0, 1, 0}), {-1, 0, 0}, 1e-15));
  TEST_ASSERT(isNear(frame.turnBack({-1, 0, 0}), {0, 1, 0}, 1e-15));
  frame.move({5, 0, 0}, {0, 0, 0}, {7, 7, 7});
  TEST_ASSERT(isNear(frame.at({1, 0, 0}), {5, 1, 0}, 1e-15));
}

TEUCHOS_UNIT_TEST(BodyFrame, CountsTurnsIn2D) {
  BodyFrame frame({0, 0, 0});
  for (int k = 0; k < 40; ++k) frame.move({0, 0, 0}, {0, 0, 0.1 * kPi}, {3, 1, 0});
  TEST_FLOATING_EQUALITY(frame.rotation()[2], 4 * kPi, 1e-14);
  TEST_ASSERT(isNear(frame.at({2, 3, 0}), {2, 3, 0}, 1e-13));  // two whole turns
}

TEUCHOS_UNIT_TEST(BodyFrame, RotationVectorsIn3D) {
  for (const double angle : {1e-12, 1e-5, 1e-4, 0.3, 3.1}) {
    const Point vector = scaled(angle / 3.0, {2, -1, 2});
    TEST_ASSERT(isNear(rotationVector(rotationBy(vector)), vector, 1e-15 + 1e-14 * angle));
  }
  // Turns about x and about y by a quarter: together a third of a turn about (1, 1, 1).
  BodyFrame frame({0, 0, 0});
  frame.move({0, 0, 0}, {0, kPi / 2, 0}, {0, 0, 0});
  frame.move({0, 0, 0}, {kPi / 2, 0, 0}, {0, 0, 0});
  const BodyFrame same = BodyFrame::ofNumbers(frame.numbers());
  TEST_ASSERT(same.at({3, 1, 2}) == frame.at({3, 1, 2}));
  TEST_ASSERT(same.numbers() == frame.numbers());
  const double part = 2 * kPi / 3 / std::sqrt(3.0);
  TEST_ASSERT(isNear(frame.rotation(), {part, part, part}, 1e-14));
}

// A helix of radius 2 that rises by 0.5: its length, in the direction at its end.
TEUCHOS_UNIT_TEST(BodyFrame, ArcsHaveTheDirectionOfTheirEnd) {
  for (const double angle : {1e-9, 0.3, 1.5, 3.1}) {
    const Point end{2 * std::cos(angle), 2 * std::sin(angle), 0.5}, way = endOfArc(minus(end, {2, 0, 0}), {0, 0, angle});
    TEST_ASSERT(isNear(way, {-2 * angle * std::sin(angle), 2 * angle * std::cos(angle), 0.5}, 1e-14));
  }
  TEST_ASSERT(endOfArc({1, 2, 3}, {0, 0, 0}) == (Point{1, 2, 3}));
}

TEUCHOS_UNIT_TEST(BodyFrame, TurnsBetweenFrames) {
  BodyFrame from({0, 0, 0}), to({0, 0, 0});
  from.move({0, 0, 0}, {0, 0, 0.5}, {0, 0, 0});
  for (int k = 0; k < 10; ++k) to.move({0, 0, 0}, {0, 0, 1.0}, {4, 2, 0});
  TEST_ASSERT(isNear(turnBetween(from, to), {0, 0, 9.5}, 1e-14));  // more than a turn
  from.move({0, 0, 0}, {0.4, 0, 0}, {0, 0, 0});
  to = from;
  to.move({1, 0, 0}, {0.1, -0.2, 0.3}, {7, 0, 0});
  TEST_ASSERT(isNear(turnBetween(from, to), {0.1, -0.2, 0.3}, 1e-14));
  const Point place{3, -1, 2};
  TEST_ASSERT(isNear(to.at(to.drawnAt(place)), place, 1e-14));
}

}  // namespace
