// A tree of boxes against a check of every box.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>

#include <random>

using namespace suture;

namespace {

bool overlap(const BoundingBox& a, const BoundingBox& b) {
  for (int k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

/// Boxes of all sizes in a unit cube, or in a unit square.
std::vector<BoundingBox> random(int count, int dimension, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> place(0, 1), size(0, 0.2);
  std::vector<BoundingBox> boxes(count);
  for (BoundingBox& box : boxes) {
    Point low{0, 0, 0}, high{0, 0, 0};
    for (int k = 0; k < dimension; ++k) low[k] = place(engine), high[k] = low[k] + size(engine);
    box.include(low);
    box.include(high);
  }
  return boxes;
}

}  // namespace

TEUCHOS_UNIT_TEST(BoxTree, FindsTheSameBoxesAsACheckOfAll) {
  for (const int dimension : {2, 3})
    for (const int count : {0, 1, 2, 3, 5, 100, 1000}) {
      const std::vector<BoundingBox> boxes = random(count, dimension, 1);
      const BoxTree tree(boxes);
      for (const BoundingBox& wanted : random(50, dimension, 2)) {
        std::vector<int> expected;
        for (int i = 0; i < count; ++i)
          if (overlap(boxes[i], wanted)) expected.push_back(i);
        TEST_ASSERT(tree.find([&](const BoundingBox& box) { return overlap(box, wanted); }) == expected);
      }
    }
}

TEUCHOS_UNIT_TEST(BoxTree, FindsTheNearestPoint) {
  for (const int dimension : {2, 3}) {
    std::vector<BoundingBox> points = random(1000, dimension, 3);
    for (BoundingBox& point : points) point.high = point.low;
    const BoxTree tree(points);
    for (const BoundingBox& from : random(200, dimension, 4)) {
      const auto distance = [&](int i) { return norm(minus(points[i].low, from.high)); };
      int expected = 0;
      for (int i = 1; i < 1000; ++i)
        if (distance(i) < distance(expected)) expected = i;
      TEST_EQUALITY(tree.nearest(from.high, distance), expected);
    }
  }
}

TEUCHOS_UNIT_TEST(BoxTree, TakesTheLowestOfEquallyNearPoints) {
  std::vector<BoundingBox> points(9);
  for (int i = 0; i < 9; ++i) points[i].include(Point{double(i % 3), 0, 0});
  const BoxTree tree(points);
  TEST_EQUALITY(tree.nearest({1.5, 2, 0}, [&](int i) { return norm(minus(points[i].low, {1.5, 2, 0})); }), 1);
  TEST_EQUALITY(BoxTree({}).nearest({0, 0, 0}, [](int) { return 0.0; }), -1);
}
