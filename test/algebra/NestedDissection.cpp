#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/elimination/NestedDissection.hpp>

#include <algorithm>
#include <numeric>
#include <random>

namespace suture {
namespace {

// Nodes of a grid of squares with both diagonals, in random order, and their coordinates.
struct Grid {
  Adjacency graph;
  std::vector<Point> places;

  Grid(int nx, int ny, unsigned seed) {
    std::vector<int> vertexAt(nx * ny);
    std::iota(vertexAt.begin(), vertexAt.end(), 0);
    std::shuffle(vertexAt.begin(), vertexAt.end(), std::mt19937(seed));
    std::vector<int> nodeOf(nx * ny);
    for (int node = 0; node < nx * ny; ++node) nodeOf[vertexAt[node]] = node;
    for (const int node : nodeOf) {
      const int i = node % nx, j = node / nx;
      places.push_back({0.5 * i, 0.5 * j, 0.0});
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, ny - 1); ++b)
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, nx - 1); ++a)
          if (a != i || b != j) graph.adjacent.push_back(vertexAt[b * nx + a]);
      graph.first.push_back(static_cast<int>(graph.adjacent.size()));
    }
  }
};

// Every vertex occurs once, and no block is empty.
void expectOrder(const DissectionOrder& found, int count, bool& success, Teuchos::FancyOStream& out) {
  std::vector<int> sorted(found.order);
  std::sort(sorted.begin(), sorted.end());
  TEST_EQUALITY(static_cast<int>(sorted.size()), count);
  for (int i = 0; i < count; ++i) TEST_EQUALITY(sorted[i], i);
  TEST_ASSERT(std::is_sorted(found.ends.begin(), found.ends.end()));
  TEST_ASSERT(std::adjacent_find(found.ends.begin(), found.ends.end()) == found.ends.end());  // none is empty
  TEST_EQUALITY(found.ends.empty() ? 0 : found.ends.back(), count);
}

TEUCHOS_UNIT_TEST(NestedDissection, OrdersEveryVertexOnce) {
  for (const auto& [nx, ny] : {std::pair(1, 1), std::pair(1, 40), std::pair(13, 7), std::pair(30, 30)})
    for (const int leaf : {1, 4, 1000})
      for (const bool places : {true, false}) {
        Grid grid(nx, ny, 3);
        if (!places) grid.places.assign(nx * ny, Point{2, 2, 2});
        for (const int count : {0, nx * ny / 2, nx * ny})
          expectOrder(nestedDissection(grid.graph, grid.places, count, leaf), count, success, out);
      }
}

// A line separates a square of n x n nodes, with one step if n is odd; half as long in each half. The rest of the square is in two parts of
// nearly the same size.
TEUCHOS_UNIT_TEST(NestedDissection, SeparatesAGridByItsMiddleLine) {
  for (const int n : {30, 31}) {
    const Grid grid(n, n, 5);
    const DissectionOrder found = nestedDissection(grid.graph, grid.places, n * n, 8);
    const std::vector<int>& ends = found.ends;
    const int blocks = static_cast<int>(ends.size()), last = n * n - ends[blocks - 2], before = ends[blocks - 2] - ends[blocks - 3];
    TEST_COMPARE(last, <=, n + 1);
    TEST_COMPARE(before, <=, n / 2 + 2);
    std::vector<int> part(n * n, -1);
    for (int k = ends[blocks - 2]; k < n * n; ++k) part[found.order[k]] = 0;  // the separator
    std::vector<int> sizes;
    for (int v = 0; v < n * n; ++v) {
      if (part[v] >= 0) continue;
      sizes.push_back(0);
      std::vector<int> front = {v};
      part[v] = static_cast<int>(sizes.size());
      while (!front.empty()) {
        const int here = front.back();
        front.pop_back();
        ++sizes.back();
        for (const int other : grid.graph.of(here))
          if (part[other] < 0) {
            part[other] = part[here];
            front.push_back(other);
          }
      }
    }
    TEST_EQUALITY(static_cast<int>(sizes.size()), 2);
    TEST_COMPARE(std::abs(sizes.front() - sizes.back()), <=, n + 1);
  }
}

}  // namespace
}  // namespace suture
