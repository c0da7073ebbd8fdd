// Nodes that face each other, on surfaces whose partners are known.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/FacingNodes.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace suture;

namespace {

struct Sides {
  std::vector<Point> points;
  std::vector<std::vector<int>> nodes;
  Surface surface(int dimension) const { return {dimension, points, nodes}; }
};

/// The same sides with other numbers, in another order; in 3D each may begin at another vertex.
Sides shuffled(const Sides& sides, unsigned seed, int vertices = 0) {
  std::mt19937 engine(seed);
  std::vector<int> number(sides.points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), engine);
  Sides result{std::vector<Point>(sides.points.size()), sides.nodes};
  for (std::size_t i = 0; i < number.size(); ++i) result.points[number[i]] = sides.points[i];
  for (std::vector<int>& side : result.nodes) {
    for (int& node : side) node = number[node];
    for (int begin = 0; vertices > 0 && begin < int(side.size()) && begin + vertices <= int(side.size()); begin += vertices)
      std::rotate(side.begin() + begin, side.begin() + begin + 1, side.begin() + begin + vertices);
  }
  std::shuffle(result.nodes.begin(), result.nodes.end(), engine);
  return result;
}

/// The sides seen from behind, shifted.
Sides facing(Sides sides, int vertices, const Point& by) {
  for (Point& point : sides.points) point = plus(point, by);
  for (std::vector<int>& side : sides.nodes) {
    std::reverse(side.begin(), side.begin() + vertices);
    if (vertices > 2 && int(side.size()) >= 2 * vertices)  // middles of edges: that of the last edge stays the last
      std::reverse(side.begin() + vertices, side.begin() + 2 * vertices - 1);
  }
  return sides;
}

/// nx x ny quadrilaterals of size one on z = 0, of four, eight or nine nodes.
Sides grid(int nx, int ny, int order) {
  const int step = order == 4 ? 1 : 2, width = step * nx + 1;
  Sides sides;
  for (int j = 0; j <= step * ny; ++j)
    for (int i = 0; i < width; ++i) sides.points.push_back({double(i) / step, double(j) / step, 0});
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const auto at = [&](int a, int b) { return (step * j + b) * width + step * i + a; };
      std::vector<int> side{at(0, 0), at(step, 0), at(step, step), at(0, step)};
      if (order > 4) side.insert(side.end(), {at(1, 0), at(2, 1), at(1, 2), at(0, 1)});
      if (order == 9) side.push_back(at(1, 1));
      sides.nodes.push_back(side);
    }
  return sides;
}

Sides circle(int n, double radius, double from, bool outwards) {
  Sides sides;
  for (int i = 0; i < n; ++i) {
    const double angle = from + 2 * M_PI * i / n;
    sides.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    const int next = (i + 1) % n;
    sides.nodes.push_back(outwards ? std::vector<int>{i, next} : std::vector<int>{next, i});
  }
  return sides;
}

/// Largest distance of partners from their expected places.
double farthest(const Surface& a, const Surface& b, const std::optional<FacingNodes::Partners>& partners,
                const std::function<Point(Point)>& expected) {
  if (!partners || partners->size() != a.nodes().size()) return 1e300;
  double most = 0;
  for (const auto& [own, other] : *partners) most = std::max(most, norm(minus(b.at(other).position, expected(a.at(own).position))));
  return most;
}

}  // namespace

TEUCHOS_UNIT_TEST(FacingNodes, MeetInOppositeOrderOnLines) {
  for (const int nodes : {2, 3}) {
    Sides line;
    for (int i = 0; i <= 6; ++i) line.points.push_back({0.5 * i * i, 0, 0});
    for (int i = 0; i < 6; i += nodes - 1)
      line.nodes.push_back(nodes == 2 ? std::vector<int>{i, i + 1} : std::vector<int>{i, i + 2, i + 1});
    const Surface a = shuffled(line, 1).surface(2), b = shuffled(facing(line, 2, {0.1, 2, 0}), 2).surface(2);
    const FacingNodes search(a, b);
    TEST_COMPARE(farthest(a, b, search.between(0, 0), [](Point p) { return plus(p, {0.1, 2, 0}); }), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(FacingNodes, TakeTheNearestTurnOfARing) {
  for (const int n : {5, 24}) {
    const Surface a = circle(n, 1, 0, true).surface(2), b = shuffled(circle(n, 1.5, M_PI / 3 * 0.01, false), 3).surface(2);
    const FacingNodes search(a, b);
    const double turn = M_PI / 3 * 0.01;
    const auto expected = [&](Point p) {
      return Point{1.5 * (p[0] * std::cos(turn) - p[1] * std::sin(turn)), 1.5 * (p[0] * std::sin(turn) + p[1] * std::cos(turn)), 0};
    };
    TEST_COMPARE(farthest(a, b, search.between(0, 0), expected), <, 1e-13);
    const Surface other = circle(n + 1, 1.5, 0, false).surface(2);
    TEST_ASSERT(!FacingNodes(a, other).between(0, 0));
  }
}

TEUCHOS_UNIT_TEST(FacingNodes, StandOppositeOnSurfacesInSpace) {
  for (const int order : {4, 8, 9})
    for (const auto& [nx, ny] : {std::pair(1, 1), std::pair(3, 2), std::pair(3, 3)}) {  // a square fits in four ways
      const Sides sides = grid(nx, ny, order);
      const Surface a = shuffled(sides, 4, 4).surface(3), b = shuffled(facing(sides, 4, {0.1, -0.2, 0.7}), 5, 4).surface(3);
      const FacingNodes search(a, b);
      TEST_EQUALITY(search.partsOfA(), 1);
      TEST_COMPARE(farthest(a, b, search.between(0, 0), [](Point p) { return plus(p, {0.1, -0.2, 0.7}); }), <, 1e-14);
    }
}

// A cube within a larger one: twelve triangles each, no rim.
TEUCHOS_UNIT_TEST(FacingNodes, FaceEachOtherOnACubeInACube) {
  Sides cube;
  for (int i = 0; i < 8; ++i) cube.points.push_back({2.0 * (i & 1) - 1, 2.0 * (i >> 1 & 1) - 1, 2.0 * (i >> 2) - 1});
  for (const std::vector<int>& f :
       std::vector<std::vector<int>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    cube.nodes.push_back({f[0], f[1], f[2]});
    cube.nodes.push_back({f[0], f[2], f[3]});
  }
  Sides shell = facing(cube, 3, {0, 0, 0});
  for (Point& point : shell.points) point = scaled(1.2, point);
  const Surface a = shuffled(cube, 6, 3).surface(3), b = shuffled(shell, 7, 3).surface(3);
  TEST_COMPARE(farthest(a, b, FacingNodes(a, b).between(0, 0), [](Point p) { return scaled(1.2, p); }), <, 1e-14);
}

TEUCHOS_UNIT_TEST(FacingNodes, AreNoneOfOtherSides) {
  const Surface a = grid(3, 2, 4).surface(3);
  TEST_ASSERT(!FacingNodes(a, facing(grid(6, 1, 4), 4, {0, 0, 1}).surface(3)).between(0, 0));
  TEST_ASSERT(!FacingNodes(a, facing(grid(2, 2, 4), 4, {0, 0, 1}).surface(3)).between(0, 0));
  TEST_ASSERT(!FacingNodes(a, facing(grid(3, 2, 8), 4, {0, 0, 1}).surface(3)).between(0, 0));
}
