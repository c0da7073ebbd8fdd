#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/SurfaceOrder.hpp>

#include <cmath>

using namespace suture;

namespace {

/// Nodes 0 .. n - 1 on a circle, clockwise, so that the body on the left is outside of it.
std::vector<Point> circle(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.push_back({std::cos(2 * M_PI * i / n), -std::sin(2 * M_PI * i / n), 0});
  return points;
}

std::vector<int> nodesOf(const std::vector<OrderedNode>& order) {
  std::vector<int> nodes;
  for (const OrderedNode& one : order) nodes.push_back(one.node);
  return nodes;
}

}  // namespace

TEUCHOS_UNIT_TEST(SurfaceOrder, FollowsTheSidesOfAPlaneSurface) {
  const std::vector<Point> points{{0, 0, 0}, {3, 4, 0}, {3, 9, 0}, {20, 0, 0}, {21, 0, 0}, {20.5, 0, 0}};
  // Two lines: 2 -> 1 -> 0, and one of a side with three nodes, 4 -> 5 -> 3.
  const Surface surface(2, points, {{1, 0}, {4, 3, 5}, {2, 1}});
  const std::vector<SurfaceRun> runs = runsOf(surface);
  TEST_EQUALITY(runs.size(), 2u);
  TEST_ASSERT(runs[0].nodes == (std::vector<int>{2, 1, 0}) && !runs[0].closed);
  TEST_ASSERT(runs[0].arc == (std::vector<double>{0, 5, 10}));
  TEST_ASSERT(runs[1].nodes == (std::vector<int>{4, 5, 3}));
  TEST_ASSERT(nodesOf(inOrder(surface, [](int node) { return node != 1; })) == (std::vector<int>{2, 0, 4, 5, 3}));
  TEST_ASSERT(runsOf(Surface(2, points, {{0, 1}, {1, 2}, {1, 3}})).empty());  // branches
}

TEUCHOS_UNIT_TEST(SurfaceOrder, BeginsARingAtItsLowestNodeOrBehindAGap) {
  const Surface ring(2, circle(6), {{3, 4}, {4, 5}, {5, 0}, {0, 1}, {1, 2}, {2, 3}});
  const std::vector<SurfaceRun> runs = runsOf(ring);
  TEST_EQUALITY(runs.size(), 1u);
  TEST_ASSERT(runs[0].closed && runs[0].nodes == (std::vector<int>{0, 1, 2, 3, 4, 5}));
  TEST_FLOATING_EQUALITY(runs[0].arc.back(), 5.0, 1e-14);
  TEST_ASSERT(nodesOf(inOrder(ring, [](int) { return true; })) == (std::vector<int>{0, 1, 2, 3, 4, 5}));
  TEST_ASSERT(nodesOf(inOrder(ring, [](int node) { return node != 2; })) == (std::vector<int>{3, 4, 5, 0, 1}));
}

TEUCHOS_UNIT_TEST(SurfaceOrder, HasNoArcLengthIn3D) {
  const Surface square(3, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  TEST_THROW(runsOf(square), InternalError);
  const std::vector<OrderedNode> order = inOrder(square, [](int node) { return node != 2; });
  TEST_ASSERT(nodesOf(order) == (std::vector<int>{0, 1, 3}));
  for (const OrderedNode& one : order) TEST_EQUALITY(one.arc, 0.0);
}
