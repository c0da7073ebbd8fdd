// Edges and sides of every cell against its drawing.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <mesh/ReferenceCells.hpp>

using namespace suture;

namespace {

const std::vector<Point> skewed{{2, 0.5, 0.1}, {1, 3, -0.4}, {0.3, -0.2, 1.5}};

double distanceFromMean(const CellBlock& block, int node, const std::vector<int>& of) {
  Point mean{0, 0, 0};
  for (const int i : of) mean = plus(mean, scaled(1.0 / double(of.size()), block.point(i)));
  return norm(minus(block.point(node), mean));
}

}  // namespace

TEUCHOS_UNIT_TEST(Cell, SidesRunRoundTheCellWithTheBodyOnTheLeft) {
  for (const Cell cell : referencecells::plane) {
    const CellBlock block = referencecells::image(cell, skewed);
    const Point centre = centreOf(block, 0);
    const int sides = static_cast<int>(cellInfo(cell).sideNodes.size());
    for (int s = 0; s < sides; ++s) {
      const std::vector<int> nodes = block.nodesOf(Side{0, s});
      TEST_EQUALITY(nodes[1], block.nodesOf(Side{0, (s + 1) % sides})[0]);
      const Point a = block.point(nodes[0]), b = block.point(nodes[1]);
      TEST_COMPARE(cross(minus(b, a), minus(centre, a))[2], >, 0);
      if (nodes.size() == 3) TEST_COMPARE(distanceFromMean(block, nodes[2], {nodes[0], nodes[1]}), <, 1e-14);
    }
  }
}

TEUCHOS_UNIT_TEST(Cell, EdgesAreThoseOfTheDrawingInTheOrderOfTheirMiddles) {
  for (const Cell cell : referencecells::all()) {
    const CellInfo& info = cellInfo(cell);
    const CellBlock block = referencecells::image(cell, skewed);
    std::set<std::pair<int, int>> edges;
    for (std::size_t e = 0; e < info.edges.size(); ++e) {
      const auto [a, b] = info.edges[e];
      TEST_ASSERT(edges.insert(std::minmax(a, b)).second && a < info.vertices && b < info.vertices && a != b);
      if (info.order == 2) TEST_COMPARE(distanceFromMean(block, info.vertices + static_cast<int>(e), {a, b}), <, 1e-14);
    }
    // Euler: vertices - edges + sides = 2; in 2D there are as many edges as vertices.
    const int sides = static_cast<int>(info.sideNodes.size()), vertices = info.vertices;
    TEST_EQUALITY(static_cast<int>(edges.size()), info.dimension == 2 ? vertices : vertices + sides - 2);
  }
}

// Every vertex of a convex cell lies on a side or behind it, and every edge is traversed once in each direction.
TEUCHOS_UNIT_TEST(Cell, SidesIn3DRunCounterClockwiseSeenFromOutside) {
  for (const Cell cell : referencecells::solid) {
    const CellInfo& info = cellInfo(cell);
    const CellBlock block = referencecells::image(cell, skewed);
    std::multiset<std::pair<int, int>> steps;
    for (std::size_t s = 0; s < info.sideNodes.size(); ++s) {
      const std::vector<int>& nodes = info.sideNodes[s];
      std::vector<int> vertices;
      for (const int node : nodes)
        if (node < info.vertices) vertices.push_back(node);
      const std::size_t n = vertices.size();
      TEST_ASSERT(n == 3 || n == 4);
      TEST_ASSERT(std::equal(vertices.begin(), vertices.end(), nodes.begin()));
      TEST_EQUALITY(nodes.size(), info.order == 1 ? n : cell == Cell::Hexahedron27 ? 9 : 2 * n);
      const Point origin = block.point(vertices[0]);
      for (std::size_t k = 0; k < n; ++k) {
        const int a = vertices[k], b = vertices[(k + 1) % n], c = vertices[(k + 2) % n];
        steps.insert({a, b});
        const Point normal = cross(minus(block.point(b), block.point(a)), minus(block.point(c), block.point(b)));
        for (int i = 0; i < info.vertices; ++i) {
          const double height = dot(normal, minus(block.point(i), origin));
          const bool isOfTheSide = std::count(vertices.begin(), vertices.end(), i) > 0;
          TEST_COMPARE(isOfTheSide ? std::abs(height) - 1e-13 : height + 0.1, <, 0);
        }
        if (info.order == 2) TEST_COMPARE(distanceFromMean(block, nodes[n + k], {a, b}), <, 1e-14);
      }
      if (nodes.size() == 9) TEST_COMPARE(distanceFromMean(block, nodes[8], vertices), <, 1e-14);
    }
    TEST_EQUALITY(steps.size(), 2 * info.edges.size());
    for (const auto& [a, b] : info.edges) {
      TEST_EQUALITY(steps.count({a, b}), 1u);
      TEST_EQUALITY(steps.count({b, a}), 1u);
    }
  }
}

TEUCHOS_UNIT_TEST(Cell, SidesThatTwoElementsShareHaveTheSameKey) {
  for (const Cell cell : referencecells::solid) {
    Box box;
    box.cell = cell;
    box.nx = 3, box.ny = box.nz = 2;
    const Mesh mesh = boxes({box});
    std::map<std::set<int>, SideKey> keyOf;  // by all vertices
    std::map<SideKey, std::set<int>> verticesOf;
    std::map<SideKey, int> count;
    for (int e = 0; e < mesh.elements(); ++e)
      forEachSide(mesh, e, [&](const SideKey& key, const Side& side) {
        std::set<int> vertices;
        for (const int local : cellInfo(cell).sideNodes[side.side])
          if (local < cellInfo(cell).vertices) vertices.insert(mesh.nodesOf(e)[local]);
        TEST_ASSERT(mesh.keyOf(side) == key);
        TEST_ASSERT(keyOf.emplace(vertices, key).first->second == key);
        TEST_ASSERT(verticesOf.emplace(key, vertices).first->second == vertices);
        ++count[key];
      });
    int outside = 0, named = 0;
    for (const auto& entry : count) {
      TEST_COMPARE(entry.second, <=, 2);
      outside += entry.second == 1;
    }
    for (const auto& group : mesh.sideGroups) named += static_cast<int>(group.second.size());
    TEST_EQUALITY(outside, named);
  }
}

TEUCHOS_UNIT_TEST(Cell, KeysDoNotDependOnTheOrderOfTheVertices) {
  std::vector<int> vertices{4, 7, 1, 9};
  std::sort(vertices.begin(), vertices.end());
  const SideKey four = sideKey(vertices.data(), 4), three = sideKey(vertices.data(), 3);
  do {
    TEST_ASSERT(sideKey(vertices.data(), 4) == four);
    if (vertices[3] == 9) TEST_ASSERT(sideKey(vertices.data(), 3) == three);
  } while (std::next_permutation(vertices.begin(), vertices.end()));
  const int other[] = {4, 7, 2, 9};
  TEST_ASSERT(!(sideKey(other, 4) == four));
}
