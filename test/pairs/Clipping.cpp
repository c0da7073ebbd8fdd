// Intersections of polygons, and quadrature over triangles, against closed forms.
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <random>
#include <suture/pairs/mortar/Clipping.hpp>

using namespace suture;

namespace {

Polygon ring(int corners, double radius, double angle, PlanePoint centre = {0, 0}) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const double at = angle + 2 * M_PI * k / corners;
    polygon.push_back({centre[0] + radius * std::cos(at), centre[1] + radius * std::sin(at)});
  }
  return polygon;
}

double factorial(int n) { return n <= 1 ? 1.0 : n * factorial(n - 1); }

}  // namespace

TEUCHOS_UNIT_TEST(Clipping, FindsTheOctagonOfTwoSquares) {
  const Polygon straight = ring(4, std::sqrt(2.0), M_PI / 4), turned = ring(4, std::sqrt(2.0), 0);  // squares of side two
  const Polygon common = commonPart(straight, turned, 1e-12);
  TEST_EQUALITY(common.size(), std::size_t(8));
  TEST_FLOATING_EQUALITY(areaOf(common), 8 * (std::sqrt(2.0) - 1), 1e-14);
  TEST_FLOATING_EQUALITY(areaOf(commonPart(turned, straight, 1e-12)), 8 * (std::sqrt(2.0) - 1), 1e-14);
}

TEUCHOS_UNIT_TEST(Clipping, HasNothingInCommonAcrossASharedEdgeDespiteRoundOff) {
  const Polygon square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const double off : {0.0, 1e-16, -1e-16, 3e-14, -3e-14}) {
    TEST_ASSERT(commonPart({{1 + off, 0}, {2, 0}, {2, 1}, {1 + off, 1}}, square, 1e-12).empty());
    TEST_FLOATING_EQUALITY(areaOf(commonPart({{off, off}, {1, off}, {1, 1 + off}, {off, 1}}, square, 1e-12)), 1.0, 1e-12);
  }
  TEST_ASSERT(commonPart({{3, 3}, {4, 3}, {4, 4}}, square, 1e-12).empty());
}

// The pieces of a polygon cut along lines add up to it.
TEUCHOS_UNIT_TEST(Clipping, DividesAPolygonAmongTheCellsOfAGrid) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> some(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const Polygon polygon = ring(3 + trial % 2, 0.3 + some(generator), some(generator), {1.5 + some(generator), 1.5 + some(generator)});
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double x = i, y = j;
        sum += areaOf(commonPart(polygon, {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}, 1e-12));
      }
    TEST_FLOATING_EQUALITY(sum, areaOf(polygon), 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Clipping, CutsAQuadrilateralWithAnInwardCornerIntoTwoTriangles) {
  for (int first = 0; first < 4; ++first) {
    Polygon arrow{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
    std::rotate(arrow.begin(), arrow.begin() + first, arrow.end());
    const std::vector<std::vector<int>> parts = convexParts(arrow);
    TEST_EQUALITY(parts.size(), std::size_t(2));
    double sum = 0;
    for (const std::vector<int>& corners : parts) {
      Polygon triangle;
      for (const int corner : corners) triangle.push_back(arrow[corner]);
      TEST_COMPARE(areaOf(triangle), >, 0.0);
      sum += areaOf(triangle);
    }
    TEST_FLOATING_EQUALITY(sum, areaOf(arrow), 1e-14);
  }
  TEST_EQUALITY(convexParts({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).size(), std::size_t(1));
}

// int of l_1^a l_2^b l_3^c over a triangle: 2 a! b! c! / (a + b + c + 2)! times its area.
TEUCHOS_UNIT_TEST(Clipping, IntegratesPolynomialsOverTriangles) {
  for (const int degree : {1, 5, 6, 7, 10})
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b) {
        const int c = degree - a - b;
        const TriangleRule& rule = triangleRule(degree);
        double sum = 0;
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          sum += rule.weights[q] * std::pow(rule.points[q][0], a) * std::pow(rule.points[q][1], b) * std::pow(rule.points[q][2], c);
        TEST_FLOATING_EQUALITY(sum, 2 * factorial(a) * factorial(b) * factorial(c) / factorial(degree + 2), 1e-13);
      }
  TEST_EQUALITY(triangleRule(5).points.size(), std::size_t(7));
}
