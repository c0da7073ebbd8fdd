#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>

namespace suture {
namespace {

constexpr double pi = 3.14159265358979323846;

TEUCHOS_UNIT_TEST(Point, HasThreeComponents) {
  const Point a{1, 2, 3}, b{-4, 5, 6};
  TEST_EQUALITY(dot(a, b), 24.0);
  TEST_ASSERT(cross(a, b) == (Point{-3, -18, 13}));
  TEST_ASSERT(plus(a, b) == (Point{-3, 7, 9}));
  TEST_ASSERT(minus(a, b) == (Point{5, -3, -3}));
  TEST_ASSERT(scaled(2, a) == (Point{2, 4, 6}));
  TEST_FLOATING_EQUALITY(norm({2, 3, 6}), 7.0, 1e-15);
  TEST_EQUALITY(norm({3, -4, 0}), 5.0);
  TEST_FLOATING_EQUALITY(norm({3e200, 4e200, 0}), 5e200, 1e-15);  // squares do not overflow
}

// Lagrange's identity and orthogonality: the contribution of z is not lost.
TEUCHOS_UNIT_TEST(Point, CrossProductsAreOrthogonalToBothFactors) {
  const Point a{0.3, -1.7, 2.9}, b{4.1, 0.2, -0.6}, c = cross(a, b);
  TEST_COMPARE(std::abs(dot(a, c)) + std::abs(dot(b, c)), <, 1e-14);
  TEST_FLOATING_EQUALITY(dot(c, c), dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b), 1e-14);
}

TEUCHOS_UNIT_TEST(Point, UnitVectorsAlongAxesAreExact) {
  TEST_ASSERT(unit({0, -7.3, 0}) == (Point{0, -1, 0}));
  TEST_ASSERT(unit({1e-11, 0, 2.5}) == (Point{0, 0, 1}));
  TEST_ASSERT(unit({-3, 1e-10, -1e-10}) == (Point{-1, 0, 0}));
  TEST_FLOATING_EQUALITY(norm(unit({1, 2, 3})), 1.0, 1e-15);
  const Point nearly = unit({1, 1, 1e-11});
  TEST_EQUALITY(nearly[2], 0.0);
  TEST_FLOATING_EQUALITY(norm(nearly), 1.0, 1e-15);
}

TEUCHOS_UNIT_TEST(Point, AnglesAreThoseIn3D) {
  TEST_FLOATING_EQUALITY(angleBetween({1, 0, 0}, {0, 0, 2}), pi / 2, 1e-15);
  TEST_FLOATING_EQUALITY(angleBetween({1, 1, 0}, {-1, -1, 0}), pi, 1e-15);
  TEST_FLOATING_EQUALITY(angleBetween({1, 1, 1}, {1, 0, 0}), std::acos(1 / std::sqrt(3.0)), 1e-14);
  TEST_FLOATING_EQUALITY(angleBetween({1, 0, 1e-9}, {1, 0, 0}), 1e-9, 1e-12);  // no loss near zero
}

}  // namespace
}  // namespace suture
