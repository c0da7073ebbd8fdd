// Entities of graphs made by hand, in 2D and 3D.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <functional>
#include <set>
#include <suture/base/Errors.hpp>
#include <suture/partition/EntityGraph.hpp>

using namespace suture;

namespace {

int countOf(const std::vector<SeamEntity>& all, EntityKind kind) {
  return static_cast<int>(std::count_if(all.begin(), all.end(), [kind](const SeamEntity& e) { return e.kind == kind; }));
}

const SeamEntity& entityAt(const std::vector<SeamEntity>& all, GlobalId node) {
  return *std::find_if(all.begin(), all.end(),
                       [node](const SeamEntity& e) { return std::find(e.nodes.begin(), e.nodes.end(), node) != e.nodes.end(); });
}

/// n^3 bricks on a lattice of n * step cells per edge (step 2: with middle nodes); each brick gets its subdomain by its centre, 0 <= x, y,
/// z < n.
struct Cube {
  int n, step;
  int side() const { return n * step + 1; }
  GlobalId node(int x, int y, int z) const { return x + side() * (y + GlobalId(side()) * z); }

  EntityGraph graph(const std::function<int(int, int, int)>& subdomainOf) const {
    std::vector<std::set<int>> sharers(side() * side() * side());
    const auto forEachCell = [&](const auto& visit) {
      for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
          for (int x = 0; x < n; ++x) visit(x, y, z);
    };
    forEachCell([&](int x, int y, int z) {
      for (int k = 0; k <= step; ++k)
        for (int j = 0; j <= step; ++j)
          for (int i = 0; i <= step; ++i) sharers[node(step * x + i, step * y + j, step * z + k)].insert(subdomainOf(x, y, z));
    });
    EntityGraph graph;
    for (std::size_t k = 0; k < sharers.size(); ++k)
      if (sharers[k].size() > 1) graph.addNode(GlobalId(k), {sharers[k].begin(), sharers[k].end()});
    forEachCell([&](int x, int y, int z) {
      for (int axis = 0; axis < 3; ++axis) {  // the side towards the next cell along the axis
        int next[3] = {x, y, z};
        if (++next[axis] == n) continue;
        const int a = subdomainOf(x, y, z), b = subdomainOf(next[0], next[1], next[2]);
        if (a == b) continue;
        const auto at = [&](int u, int v) {  // in halves of a cell on the side
          int p[3] = {step * next[0], step * next[1], step * next[2]};
          p[(axis + 1) % 3] += step * u / 2;
          p[(axis + 2) % 3] += step * v / 2;
          return node(p[0], p[1], p[2]);
        };
        std::vector<GlobalId> nodes{at(0, 0), at(2, 0), at(2, 2), at(0, 2)};
        if (step == 2) nodes.insert(nodes.end(), {at(1, 0), at(2, 1), at(1, 2), at(0, 1), at(1, 1)});
        graph.addSide(nodes, 4, {std::min(a, b), std::max(a, b)});
      }
    });
    return graph;
  }
};

int octant(const Cube& cube, int x, int y, int z) { return 4 * (2 * z / cube.n) + 2 * (2 * y / cube.n) + 2 * x / cube.n; }

}  // namespace

// By hand: three planes of four faces each, six half axes, the centre.
TEUCHOS_UNIT_TEST(EntityGraph, FindsTwelveFacesSixEdgesAndAVertexInACubeCutInEight) {
  for (const int step : {1, 2})
    for (const int n : {2, 4, 6}) {
      const Cube cube{n, step};
      const auto all = cube.graph([&](int x, int y, int z) { return octant(cube, x, y, z); }).entities();
      TEST_EQUALITY(countOf(all, EntityKind::Face), 12);
      TEST_EQUALITY(countOf(all, EntityKind::Edge), 6);
      TEST_EQUALITY(countOf(all, EntityKind::Vertex), 1);
      const std::size_t half = std::size_t(n * step) / 2;  // nodes of a half axis next to the centre
      for (const SeamEntity& entity : all) {
        const bool face = entity.kind == EntityKind::Face, edge = entity.kind == EntityKind::Edge;
        TEST_EQUALITY(entity.sharers.size(), face ? 2u : edge ? 4u : 8u);
        TEST_EQUALITY(entity.nodes.size(), face ? half * half : edge ? half : 1u);
        TEST_EQUALITY(entity.boundary.size(), face ? 3u : edge ? 1u : 0u);  // two half axes and the centre; the centre
        TEST_EQUALITY(entity.ends.size(), edge ? 1u : 0u);                  // on the surface of the cube
        for (const int lower : entity.boundary) TEST_ASSERT(all[lower].kind < entity.kind);
        if (!edge) continue;
        // in order from the centre to the surface, or back: steps along one axis
        const GlobalId stride = std::abs(entity.nodes.back() - entity.nodes.front()) / std::max<GlobalId>(1, GlobalId(half) - 1);
        for (std::size_t k = 1; k < entity.nodes.size(); ++k) TEST_EQUALITY(std::abs(entity.nodes[k] - entity.nodes[k - 1]), stride);
        TEST_ASSERT(entity.ends[0] == entity.nodes.front() || entity.ends[0] == entity.nodes.back());
      }
    }
}

// A column through the cube: its four faces meet the rest, one subdomain, along edges that only two share: one face, a ring around it.
TEUCHOS_UNIT_TEST(EntityGraph, TakesWhatTwoShareAroundAColumnForOneFace) {
  const Cube cube{3, 1};
  const auto all = cube.graph([](int x, int y, int) { return x == 1 && y == 1 ? 1 : 0; }).entities();
  TEST_EQUALITY(all.size(), 1u);
  TEST_ASSERT(all[0].kind == EntityKind::Face);
  TEST_EQUALITY(all[0].nodes.size(), 4u * 4u);
  TEST_EQUALITY(all[0].boundary.size(), 0u);
}

// Three slabs, the middle one cut in two: an edge shared by three bounds three faces on either side of the cut; the slabs do not meet.
TEUCHOS_UNIT_TEST(EntityGraph, FindsEdgesThatThreeShare) {
  const Cube cube{6, 1};
  const auto all = cube.graph([](int x, int, int z) { return z < 2 ? 0 : z >= 4 ? 3 : x < 3 ? 1 : 2; }).entities();
  TEST_EQUALITY(countOf(all, EntityKind::Face), 5);
  TEST_EQUALITY(countOf(all, EntityKind::Edge), 2);
  TEST_EQUALITY(countOf(all, EntityKind::Vertex), 0);
  for (const SeamEntity& entity : all) {
    if (entity.kind == EntityKind::Face) {
      const bool middle = entity.sharers == std::vector<int>({1, 2});
      TEST_EQUALITY(entity.boundary.size(), middle ? 2u : 1u);
      continue;
    }
    TEST_EQUALITY(entity.sharers.size(), 3u);
    TEST_EQUALITY(entity.nodes.size(), 7u);
    TEST_ASSERT(entity.ends == (std::vector<GlobalId>{entity.nodes.front(), entity.nodes.back()}));
  }
}

// Two opposite octants and the rest: the octants touch only in the centre, which all three share.
TEUCHOS_UNIT_TEST(EntityGraph, TakesAPointWhereFacesTouchForAVertex) {
  const Cube cube{2, 2};
  const auto all = cube.graph([&](int x, int y, int z) {
                         const int part = octant(cube, x, y, z);
                         return part == 0 ? 1 : part == 7 ? 2 : 0;
                       })
                       .entities();
  TEST_EQUALITY(countOf(all, EntityKind::Face), 2);
  TEST_EQUALITY(countOf(all, EntityKind::Edge), 0);
  TEST_EQUALITY(countOf(all, EntityKind::Vertex), 1);
  TEST_EQUALITY(all[0].nodes[0], cube.node(2, 2, 2));
}

// 0 - 1 - 2 - 3 - 4 between two subdomains, a third one from 4 on: by hand.
TEUCHOS_UNIT_TEST(EntityGraph, OrdersAnEdgeFromItsLowerEnd) {
  for (const bool back : {false, true}) {
    const auto number = [&](int k) { return GlobalId(back ? 4 - k : k); };
    EntityGraph graph;
    for (const int k : {3, 1, 4, 0, 2}) graph.addNode(number(k), k == 4 ? std::vector<int>{5, 7, 9} : std::vector<int>{5, 7});
    for (const int k : {2, 0, 3, 1}) graph.addSide({number(k), number(k + 1)}, 2, {5, 7});
    const auto all = graph.entities();
    TEST_EQUALITY(all.size(), 2u);
    TEST_ASSERT(all[0].kind == EntityKind::Vertex && all[0].nodes == std::vector<GlobalId>{number(4)});
    TEST_ASSERT(all[1].kind == EntityKind::Edge);
    TEST_ASSERT(all[1].nodes == (back ? std::vector<GlobalId>{1, 2, 3, 4} : std::vector<GlobalId>{0, 1, 2, 3}));
    TEST_ASSERT(all[1].ends == std::vector<GlobalId>{number(0)});
    TEST_ASSERT(all[1].boundary == std::vector<int>{0});
  }
}

// Two points shared by three subdomains, joined by a side of two of them: vertices, not an edge of three.
TEUCHOS_UNIT_TEST(EntityGraph, DoesNotJoinPointsOfThreeByASideOfTwo) {
  EntityGraph graph;
  for (const GlobalId node : {1, 2}) graph.addNode(node, {0, 1, 2});
  graph.addSide({1, 2}, 2, {0, 1});
  const auto all = graph.entities();
  TEST_EQUALITY(countOf(all, EntityKind::Vertex), 2);
  TEST_EQUALITY(all.size(), 2u);
}

TEUCHOS_UNIT_TEST(EntityGraph, KeepsSingleNodesApartAndEndsEdgesThere) {
  EntityGraph graph;
  for (GlobalId node = 0; node < 5; ++node) graph.addNode(node, {0, 1}, node == 2);
  for (GlobalId node = 0; node < 4; ++node) graph.addSide({node, node + 1}, 2, {0, 1});
  const auto all = graph.entities();
  TEST_EQUALITY(all.size(), 3u);
  TEST_ASSERT(entityAt(all, 2).kind == EntityKind::Vertex);
  for (const GlobalId node : {0, 4}) {
    TEST_EQUALITY(entityAt(all, node).nodes.size(), 2u);
    TEST_ASSERT(entityAt(all, node).ends == std::vector<GlobalId>{node});
    TEST_ASSERT(entityAt(all, node).boundary == std::vector<int>{0});
  }
}

// Coarse unknowns of clusters: those that pairs of local problems share are connected, without an order.
TEUCHOS_UNIT_TEST(EntityGraph, JoinsSetsThatOverlap) {
  EntityGraph graph;
  for (const GlobalId node : {1, 2, 3, 4, 5, 8, 9}) graph.addNode(node, node == 5 ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1});
  graph.addSet({1, 3}, {0, 1}, EntityKind::Edge);
  graph.addSet({4, 2, 3, 5}, {0, 1}, EntityKind::Edge);
  graph.addSet({8, 9}, {0, 1}, EntityKind::Edge);
  const auto all = graph.entities();
  TEST_EQUALITY(countOf(all, EntityKind::Edge), 2);
  TEST_ASSERT(all[1].nodes == (std::vector<GlobalId>{1, 2, 3, 4}));
  TEST_ASSERT(all[1].boundary == std::vector<int>{0});
  TEST_ASSERT(all[2].nodes == (std::vector<GlobalId>{8, 9}));
  TEST_EQUALITY(all[1].ends.size() + all[2].ends.size() + all[2].boundary.size(), 0u);
}

TEUCHOS_UNIT_TEST(EntityGraph, RefusesSidesOfUnknownShape) {
  EntityGraph graph;
  graph.addNode(0, {0, 1});
  TEST_THROW(graph.addSide({0}, 1, {0, 1}), InternalError);
}
