// The search for opposite sides against a check of all of them, and its cost.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/pairs/PairSearch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

using namespace suture;

namespace {

using SidePoints = std::vector<Point>;

/// Small sides at random places, and random directions.
class Scatter {
 public:
  Scatter(int dimension, unsigned seed) : dimension_(dimension), engine_(seed) {}
  Point point(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    Point p{0, 0, 0};
    for (int k = 0; k < dimension_; ++k) p[k] = any(engine_);
    return p;
  }
  SidePoints side(int nodes) {
    const Point centre = point(1);
    SidePoints all;
    for (int i = 0; i < nodes; ++i) all.push_back(plus(centre, point(0.1)));
    return all;
  }
  double number() { return std::uniform_real_distribution<double>(0, 1)(engine_); }

 private:
  int dimension_;
  std::mt19937 engine_;
};

/// Signed volume of the box spanned by a, b and c.
double volume(const Point& a, const Point& b, const Point& c) { return dot(a, cross(b, c)); }

bool has(const std::vector<int>& found, int i) { return std::binary_search(found.begin(), found.end(), i); }

/// A slightly wavy line of the given number of sides between two points.
std::vector<SidePoints> line(int sides, double height) {
  std::vector<SidePoints> all;
  const auto at = [&](int i) {
    const double x = double(i) / sides;
    return Point{x, height + 0.01 * std::sin(20 * x), 0};
  };
  for (int i = 0; i < sides; ++i) all.push_back({at(i), at(i + 1)});
  return all;
}

}  // namespace

TEUCHOS_UNIT_TEST(PairSearch, MissesNoSideThatALineMeetsInThePlane) {
  Scatter scatter(2, 1);
  std::vector<SidePoints> others;
  for (int i = 0; i < 500; ++i) others.push_back(scatter.side(2));
  const PairSearch search(others);
  std::size_t candidates = 0;
  int met = 0;
  for (int k = 0; k < 200; ++k) {
    const int nodes = 2 + k % 2;  // straight and curved
    const SidePoints own = scatter.side(nodes);
    const Point direction = scatter.point(3);
    const std::vector<int> found = search.along(own, direction);
    TEST_ASSERT(std::is_sorted(found.begin(), found.end()));
    candidates += found.size();
    for (double xi = -1; xi <= 1; xi += 0.125) {
      const SideShape shape = sideShape(nodes, xi);
      Point from{0, 0, 0};
      for (int i = 0; i < nodes; ++i) from = plus(from, scaled(shape.value[i], own[i]));
      for (int i = 0; i < 500; ++i) {
        const double a = cross(minus(others[i][0], from), direction)[2], b = cross(minus(others[i][1], from), direction)[2];
        if ((a > 0) == (b > 0)) continue;
        ++met;
        TEST_ASSERT(has(found, i));
      }
    }
  }
  TEST_COMPARE(met, >, 1000);
  TEST_COMPARE(candidates, <, 200u * 500 / 3);
}

TEUCHOS_UNIT_TEST(PairSearch, MissesNoTriangleThatALineMeetsIn3D) {
  Scatter scatter(3, 2);
  std::vector<SidePoints> others;
  for (int i = 0; i < 2000; ++i) others.push_back(scatter.side(3));
  const PairSearch search(others);
  std::size_t candidates = 0;
  int met = 0;
  for (int k = 0; k < 100; ++k) {
    const SidePoints own = scatter.side(3);
    const Point direction = scatter.point(3);
    const std::vector<int> found = search.along(own, direction);
    candidates += found.size();
    for (int sample = 0; sample < 10; ++sample) {
      double s = scatter.number(), t = scatter.number();
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Point from = plus(own[0], plus(scaled(s, minus(own[1], own[0])), scaled(t, minus(own[2], own[0]))));
      for (int i = 0; i < 2000; ++i) {
        const Point a = minus(others[i][0], from), b = minus(others[i][1], from), c = minus(others[i][2], from);
        const double u = volume(direction, a, b), v = volume(direction, b, c), w = volume(direction, c, a);
        if ((u > 0) != (v > 0) || (v > 0) != (w > 0)) continue;
        ++met;
        TEST_ASSERT(has(found, i));
      }
    }
  }
  TEST_COMPARE(met, >, 500);
  TEST_COMPARE(candidates, <, 100u * 2000 / 10);
}

TEUCHOS_UNIT_TEST(PairSearch, FindsSidesThatATouchOfTheLineEnds) {
  const PairSearch search({{{0, 1, 0}, {1, 1, 0}}, {{1, 1, 0}, {2, 1, 0}}, {{2, 1, 0}, {3, 1, 0}}});
  TEST_ASSERT(search.along({{1, 0, 0}}, {0, 1, 0}) == (std::vector<int>{0, 1}));
  TEST_ASSERT(search.along({{1, 5, 0}, {1.5, 5, 0}}, {0, -7, 0}) == (std::vector<int>{0, 1}));
  TEST_ASSERT(search.along({{-2, 0, 0}}, {1, 1, 0}).empty());
  TEST_ASSERT(search.along({{-2, 0, 0}}, {3.5, 1, 0}) == (std::vector<int>{1}));
  // A parabola through three nodes is wider than their box.
  TEST_EQUALITY(search.along({{1.4, 0, 0}, {1.6, 0, 0}, {1.99, 0, 0}}, {0, 1, 0}).size(), 2u);
}

// n sides opposite to n: box tests grow like n log n. Also far from the origin, and along a line that is not parallel to an axis.
TEUCHOS_UNIT_TEST(PairSearch, LooksAtBoxesInProportionToNLogN) {
  double perSide = 0;
  for (const int n : {1000, 10000, 100000}) {
    const std::vector<SidePoints> own = line(n, 0), others = line(n + n / 7, 0.5);
    const auto begin = std::chrono::steady_clock::now();
    const PairSearch search(others);
    std::size_t found = 0;
    for (const SidePoints& side : own) found += search.along(side, {0.1, 1, 0}).size();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    out << n << " sides: " << search.boxTests() << " box tests, " << time.count() << " s\n";
    TEST_COMPARE(found, >, std::size_t(n));
    TEST_COMPARE(found, <, std::size_t(5 * n));
    const double now = double(search.boxTests()) / (n * std::log2(n));
    TEST_COMPARE(now, <, 4.0);
    if (perSide > 0) TEST_COMPARE(now, <, 1.1 * perSide);
    perSide = now;
  }
}
