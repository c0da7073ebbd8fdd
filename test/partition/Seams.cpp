#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <numeric>
#include <set>

#include <support/SmallScenes.hpp>

#include "FoundSeams.hpp"

using namespace suture;
using namespace suture::scenes;

namespace {

// n x n squares of 8 or 9 nodes on [0,1]^2, by hand: nodes on a lattice twice as fine.
Mesh quadraticSquares(int n, Cell cell) {
  Mesh grid;
  if (!onRoot()) return grid;
  const int fine = 2 * n + 1;
  std::vector<int> number(fine * fine, -1);
  const auto node = [&](int i, int j) {
    int& known = number[j * fine + i];
    if (known < 0) {
      known = grid.nodes();
      grid.coordinates.insert(grid.coordinates.end(), {i / (2.0 * n), j / (2.0 * n)});
    }
    return known;
  };
  for (int j = 0; j < 2 * n; j += 2)
    for (int i = 0; i < 2 * n; i += 2) {
      for (int at : {node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 2),
                     node(i, j + 1)})
        grid.connectivity.push_back(at);
      if (cell == Cell::Quadrilateral9) grid.connectivity.push_back(node(i + 1, j + 1));
      grid.cells.push_back(cell);
      grid.offsets.push_back(static_cast<int>(grid.connectivity.size()));
    }
  grid.bodies = {"body"};
  grid.bodyOfElement.assign(grid.elements(), 0);
  grid.bodyOfNode.assign(grid.nodes(), 0);
  return grid;
}

}  // namespace

TEUCHOS_UNIT_TEST(Seams, KnowsVerticesAndEdgesOfBlocks) {
  // n x n blocks: (n-1)^2 cross points and 4 (n-1) ends on the boundary; 2 n (n-1) edges of cells - 1 nodes.
  for (Cell cell : {Cell::Triangle3, Cell::Quadrilateral4})
    for (int n : {2, 4}) {
      const int cells = 4;
      const Found seams = squareBlocks(n, cells, cell);
      const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
      TEST_EQUALITY(static_cast<int>(vertices.size()), (n - 1) * (n - 1));
      TEST_EQUALITY(static_cast<int>(seams.points().size()), (n - 1) * (n - 1) + 4 * (n - 1));
      TEST_EQUALITY(static_cast<int>(edges.size()), 2 * n * (n - 1));
      for (const SeamEntity& vertex : vertices) {
        TEST_EQUALITY(vertex.nodes.size(), 1u);
        TEST_EQUALITY(vertex.sharers.size(), 4u);
      }
      for (const SeamEntity& edge : edges) {
        TEST_EQUALITY(edge.sharers.size(), 2u);
        TEST_EQUALITY(edge.nodes.size(), cells - 1 + edge.ends.size());
        TEST_EQUALITY(edge.boundary.size() + edge.ends.size(), 2u);
        if (onRoot()) {
          // In order: equal steps from end to end.
          std::vector<GlobalId> way = edge.nodes;
          const std::vector<GlobalId> bounds = seams.bounds(edge);
          if (bounds[0] != way.front()) way.insert(way.begin(), bounds[0]);
          if (bounds[1] != way.back()) way.push_back(bounds[1]);
          TEST_EQUALITY(static_cast<int>(way.size()), cells + 1);
          for (std::size_t i = 1; i < way.size(); ++i) {
            const Point p = seams.point(way[i - 1]), q = seams.point(way[i]);
            TEST_FLOATING_EQUALITY(std::hypot(p[0] - q[0], p[1] - q[1]), 1.0 / (n * cells), 1e-12);
          }
        }
      }
    }
}

TEUCHOS_UNIT_TEST(Seams, FollowsAnLShapedSeam) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 8, 8)});
  const Found seams(grid, choose(grid, [](double x, double y) { return x < 0.5 && y < 0.5; }), 2);
  const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
  TEST_EQUALITY(vertices.size(), 0u);  // the kink is inside
  TEST_EQUALITY(edges.size(), 1u);
  TEST_EQUALITY(edges[0].nodes.size(), 9u);
  TEST_ASSERT(edges[0].ends == (std::vector<GlobalId>{edges[0].nodes[0], edges[0].nodes[8]}));
  if (onRoot()) {
    TEST_EQUALITY(seams.point(edges[0].nodes[4])[0], 0.5);
    TEST_EQUALITY(seams.point(edges[0].nodes[4])[1], 0.5);
  }
}

TEUCHOS_UNIT_TEST(Seams, FollowsARing) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 8, 8)});
  const Found seams(grid, choose(grid, [](double x, double y) { return std::abs(x - 0.5) < 0.25 && std::abs(y - 0.5) < 0.25; }), 2);
  TEST_EQUALITY(seams.of(EntityKind::Vertex).size(), 0u);
  const auto edges = seams.of(EntityKind::Edge);
  TEST_EQUALITY(edges.size(), 1u);
  TEST_EQUALITY(edges[0].nodes.size(), 16u);
  TEST_EQUALITY(edges[0].ends.size() + edges[0].boundary.size(), 0u);
  TEST_EQUALITY(edges[0].nodes[0], *std::min_element(edges[0].nodes.begin(), edges[0].nodes.end()));
  TEST_EQUALITY(std::set<GlobalId>(edges[0].nodes.begin(), edges[0].nodes.end()).size(), 16u);
  if (onRoot())
    for (std::size_t i = 0; i < 16; ++i) {
      const Point p = seams.point(edges[0].nodes[i]), q = seams.point(edges[0].nodes[(i + 1) % 16]);
      TEST_FLOATING_EQUALITY(std::hypot(p[0] - q[0], p[1] - q[1]), 0.125, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(Seams, BoundsALoopByItsVertexTwice) {
  // Subdomain 1 is a square in the middle, 2 is a square that meets it in one point, (0.75, 0.75), both inside 0.
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 16, 16)});
  const Found seams(grid,
                    choose(grid,
                           [](double x, double y) {
                             if (std::abs(x - 0.5) < 0.25 && std::abs(y - 0.5) < 0.25) return 1;
                             return x > 0.75 && x < 0.875 && y > 0.75 && y < 0.875 ? 2 : 0;
                           }),
                    3);
  const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
  TEST_EQUALITY(vertices.size(), 1u);
  TEST_ASSERT(vertices[0].sharers == (std::vector<int>{0, 1, 2}));
  TEST_EQUALITY(edges.size(), 2u);
  for (const SeamEntity& edge : edges) {
    TEST_EQUALITY(edge.nodes.size(), edge.sharers[1] == 1 ? 31u : 7u);
    TEST_EQUALITY(edge.ends.size(), 0u);
    TEST_ASSERT(seams.bounds(edge) == (std::vector<GlobalId>{vertices[0].nodes[0], vertices[0].nodes[0]}));
  }
}

TEUCHOS_UNIT_TEST(Seams, TakesAPointContactOfTwoSubdomainsForAVertex) {
  // A chessboard of two colours, 2 x 2 fields: four seams meet in the middle, which only two subdomains hold.
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 8, 8)});
  const Found seams(grid, choose(grid, [](double x, double y) { return (x < 0.5) == (y < 0.5); }), 2);
  const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
  TEST_EQUALITY(vertices.size(), 1u);
  TEST_ASSERT(vertices[0].sharers == (std::vector<int>{0, 1}));
  TEST_EQUALITY(edges.size(), 4u);
  for (const SeamEntity& edge : edges) {
    TEST_EQUALITY(edge.nodes.size(), 4u);
    TEST_EQUALITY(edge.ends.size(), 1u);
  }
}

TEUCHOS_UNIT_TEST(Seams, DoesNotTakeTheBoundaryOfTheBodyForASeam) {
  // A single triangle on the bottom, inside the other subdomain: its bottom side joins two seam nodes but is no seam.
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 4, 4)});
  std::vector<int> subdomainOfElement(grid.elements(), 0);
  int bottom = -1;
  for (int e = 0; e < grid.elements() && bottom < 0; ++e) {
    int below = 0;
    double left = 1, right = 0;
    for (int node : grid.nodesOf(e)) {
      below += grid.point(node)[1] == 0.0;
      left = std::min(left, grid.point(node)[0]);
      right = std::max(right, grid.point(node)[0]);
    }
    if (below == 2 && left > 0 && right < 1) bottom = e;
  }
  if (onRoot()) subdomainOfElement[bottom] = 1;
  const Found seams(grid, subdomainOfElement, 2);
  const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
  TEST_EQUALITY(vertices.size(), 0u);
  TEST_EQUALITY(edges.size(), 1u);
  TEST_EQUALITY(edges[0].nodes.size(), 3u);
  TEST_EQUALITY(edges[0].ends.size(), 2u);
  if (onRoot())
    for (const GlobalId end : edges[0].ends) TEST_EQUALITY(seams.point(end)[1], 0.0);
}

TEUCHOS_UNIT_TEST(Seams, CountsMidSideNodesOfQuadraticElements) {
  for (Cell cell : {Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const Mesh grid = quadraticSquares(4, cell);
    const Found seams(grid, choose(grid, [](double x, double y) { return (x > 0.5) + 2 * (y > 0.5); }), 4);
    const auto vertices = seams.of(EntityKind::Vertex), edges = seams.of(EntityKind::Edge);
    TEST_EQUALITY(vertices.size(), 1u);
    TEST_EQUALITY(edges.size(), 4u);
    for (const SeamEntity& edge : edges) {
      TEST_EQUALITY(edge.nodes.size(), 4u);  // the end at the boundary included
      if (onRoot()) {
        const Point p = seams.point(edge.nodes[0]), q = seams.point(edge.nodes[1]);
        TEST_FLOATING_EQUALITY(std::hypot(p[0] - q[0], p[1] - q[1]), 0.125, 1e-12);
      }
    }
  }
}

TEUCHOS_UNIT_TEST(Seams, PutsEverySeamNodeIntoOneEntityAndObeysEuler) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 40, 40)});
  for (int subdomains : {5, 16})
    for (int seed : {1, 2, 3}) {
      const Partition partition = makePartition(*comm(), grid, Constraints(), metis(subdomains, seed).list());
      const Found seams(grid, partition);
      std::map<GlobalId, int> times;
      for (const SeamEntity& entity : seams.all)
        for (GlobalId node : entity.nodes) ++times[node];
      for (const auto& [node, count] : times) TEST_EQUALITY(count, 1);
      for (const SubdomainMesh& part : seams.mine)
        for (int i = 0; i < part.nodes(); ++i) TEST_EQUALITY(times.count(part.globalNodes[i]), part.others(i).empty() ? 0u : 1u);
      // Planar graph of the square cut up: vertices, ends and the boundary as a ring through those on it; faces are the (connected)
      // subdomains. V - E + F = 1 + C (F without the outside, C connected components of the seams with the boundary). The list lacks edges
      // without interior nodes, so edges are counted from the neighbours of these points: linked points that are one side apart.
      if (!onRoot()) continue;
      const auto edges = seams.of(EntityKind::Edge);
      const std::set<GlobalId> points = seams.points();
      int onBoundary = 0, inner = 0;
      for (const SeamEntity& edge : edges) inner += edge.nodes.size() > edge.ends.size();
      for (const GlobalId node : points) {
        const Point p = seams.point(node);
        onBoundary += p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
      }
      std::map<std::pair<int, int>, std::set<int>> sideSubdomains;
      for (int e = 0; e < grid.elements(); ++e) {
        const auto nodes = grid.nodesOf(e);
        for (int i = 0; i < 3; ++i)
          if (points.count(nodes[i]) && points.count(nodes[(i + 1) % 3]))
            sideSubdomains[std::minmax(nodes[i], nodes[(i + 1) % 3])].insert(partition.subdomainOfElement[e]);
      }
      const int bare = static_cast<int>(
          std::count_if(sideSubdomains.begin(), sideSubdomains.end(), [](const auto& side) { return side.second.size() == 2; }));
      // Components by merging the ends of edges; the boundary joins all points on it, and each ring edge is a separate component.
      std::map<GlobalId, GlobalId> parent;
      const std::function<GlobalId(GlobalId)> root = [&](GlobalId node) {
        auto known = parent.emplace(node, node).first;
        return known->second == node ? node : root(known->second);
      };
      const GlobalId boundary = -1;
      int rings = 0;
      root(boundary);
      for (GlobalId node : points) {
        const Point p = seams.point(node);
        root(node);
        if (p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1) parent[root(node)] = root(boundary);
      }
      for (const SeamEntity& edge : edges) {
        const std::vector<GlobalId> bounds = seams.bounds(edge);
        if (bounds.empty())
          ++rings;
        else
          parent[root(bounds[0])] = root(bounds[1]);
      }
      for (const auto& [side, holders] : sideSubdomains)
        if (holders.size() == 2) parent[root(side.first)] = root(side.second);
      int components = rings;
      for (const auto& [node, above] : parent) components += node == above;
      // A ring has one vertex and one edge: nothing in V - E. The boundary has as many edges as vertices.
      const int vertices = static_cast<int>(points.size()) + rings;
      const int allEdges = inner + bare + onBoundary;
      TEST_EQUALITY(vertices - allEdges + subdomains, components);
    }
}

TEUCHOS_UNIT_TEST(Seams, GivesARankTheEntitiesItTouches) {
  const Found seams = squareBlocks(4, 3);
  std::set<int> ids;
  for (const SubdomainMesh& part : seams.mine) ids.insert(part.id);
  const auto touches = [&](const SeamEntity& entity) {
    return std::any_of(entity.sharers.begin(), entity.sharers.end(), [&](int s) { return ids.count(s) > 0; });
  };
  for (const SeamEntity& entity : seams.here) TEST_ASSERT(touches(entity));
  TEST_EQUALITY(static_cast<int>(seams.here.size()), static_cast<int>(std::count_if(seams.all.begin(), seams.all.end(), touches)));
}

TEUCHOS_UNIT_TEST(Seams, DescribesAnEntityAlikeOnEveryRankAndOnOne) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 30, 30)});
  for (int subdomains : {2, 9, 40}) {
    const Partition partition = makePartition(*comm(), grid, Constraints(), metis(subdomains).list());
    const Found seams(grid, partition);
    Packer packer;
    if (onRoot()) {
      Partition together = partition;
      together.rankOf.assign(subdomains, 0);
      const std::vector<SeamEntity> all = findSeams(distribute(Teuchos::SerialComm<int>(), grid, Constraints(), together));
      for (const SeamEntity& entity : all) put(entity, all, packer);
    }
    std::set<int> ids;
    for (const SubdomainMesh& part : seams.mine) ids.insert(part.id);
    Unpacker unpacker(broadcast(*comm(), packer.bytes()));
    std::size_t at = 0;
    while (!unpacker.done()) {
      const SeamEntity one = read(unpacker);
      const auto boundary = unpacker.get<std::vector<GlobalId>>();
      if (std::none_of(one.sharers.begin(), one.sharers.end(), [&](int s) { return ids.count(s) > 0; })) continue;
      TEST_COMPARE(at, <, seams.here.size());
      if (at == seams.here.size()) break;
      const SeamEntity& entity = seams.here[at++];
      TEST_ASSERT(entity.kind == one.kind && entity.sharers == one.sharers && entity.nodes == one.nodes && entity.ends == one.ends);
      TEST_EQUALITY(entity.boundary.size(), boundary.size());
      for (std::size_t k = 0; k < boundary.size(); ++k) TEST_EQUALITY(seams.here[entity.boundary[k]].nodes[0], boundary[k]);
    }
    TEST_EQUALITY(at, seams.here.size());
  }
}

TEUCHOS_UNIT_TEST(Seams, FindsNothingWithoutSeams) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 3, 3)});
  const Found seams(grid, std::vector<int>(grid.elements(), 0), 1);
  TEST_EQUALITY(seams.here.size(), 0u);
}
