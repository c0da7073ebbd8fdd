#include <Teuchos_UnitTestHarness.hpp>
#include <precond/CoarseElementsOf.hpp>
#include <suture/precond/coarse/ClusterGraph.hpp>

#include <set>

using namespace suture;
using namespace suture::blocks;

namespace {

/// Square cells of a body as local problems, column by column. Serial.
ClusterGraph cellsOf(int blocks) {
  const Scene scene = square(blocks, 1);
  const Blocks all(scene, alone());
  const CoarseElements coarse = coarseElementsOf(all, Dense(all));
  ClusterGraph graph;
  graph.unknownsOf.resize(coarse.elements.size());
  const std::vector<int> places = all.placesByName();
  for (const CoarseElement& element : coarse.elements) graph.unknownsOf[places[element.id]] = element.unknowns;
  graph.unknowns.resize(coarse.size);
  for (const auto& unknown : coarse.unknowns) graph.unknowns[unknown.id] = unknown;
  graph.findHolders();
  return graph;
}

/// Vertices and ends of edges, and the rest of each edge between them.
struct Interfaces {
  std::vector<GlobalId> points;
  std::vector<std::vector<GlobalId>> edges;
  Interfaces(const ClusterGraph& graph, const std::vector<int>& clusterOf) {
    for (const InterfaceLayout::Entity& entity : clusterEntities(graph, clusterOf)) {
      const std::vector<GlobalId>& own = entity.kind == EntityKind::Vertex ? entity.unknowns : entity.ends;
      points.insert(points.end(), own.begin(), own.end());
      if (entity.kind == EntityKind::Edge) edges.emplace_back();
      for (const GlobalId u : entity.unknowns)
        if (std::find(own.begin(), own.end(), u) == own.end()) edges.back().push_back(u);
    }
  }
};

}  // namespace

TEUCHOS_UNIT_TEST(ClusterGraph, NeighboursShareAnEdgeAndNotACornerOnly) {
  const int n = 5;
  const ElementGraph neighbours = fixedNeighbours(cellsOf(n));
  TEST_EQUALITY(neighbours.elements(), n * n);
  TEST_EQUALITY(int(neighbours.neighbours.size()), 2 * 2 * n * (n - 1));
  const auto ofFirst = neighbours.of(0);  // the cell in a corner of the square
  TEST_EQUALITY(int(ofFirst.size()), 2);
  TEST_EQUALITY(ofFirst[0], 1);
  TEST_EQUALITY(ofFirst[1], n);
}

TEUCHOS_UNIT_TEST(ClusterGraph, NormalDisplacementsOnALineLeaveItSliding) {
  ClusterGraph graph;
  graph.unknownsOf = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  for (int k = 0; k < 4; ++k) graph.unknowns.push_back({k, {1.0 * k, 0, 0}, {0, 1, 0}});
  graph.findHolders();
  TEST_EQUALITY(int(fixedNeighbours(graph).neighbours.size()), 0);
  // One displacement along the line stops it; averages do as well as points.
  graph.unknowns[3].direction = {1, 0, 0};
  TEST_EQUALITY(int(fixedNeighbours(graph).neighbours.size()), 2);
}

TEUCHOS_UNIT_TEST(ClusterGraph, TwoHalvesMeetAtOneEdgeWithBothEndsHeld) {
  const int n = 4;
  const ClusterGraph graph = cellsOf(n);
  std::vector<int> halves;
  for (int cell = 0; cell < n * n; ++cell) halves.push_back(cell / n < n / 2 ? 0 : 1);
  const Interfaces found(graph, halves);
  TEST_EQUALITY(int(found.points.size()), 2 * 2);  // two points
  for (const GlobalId corner : found.points) {
    const Point& p = graph.unknowns[corner].point;
    TEST_FLOATING_EQUALITY(p[0], 0.5, 1e-12);
    TEST_FLOATING_EQUALITY(std::abs(p[1] - 0.5), 0.5, 1e-12);
  }
  TEST_EQUALITY(int(found.edges.size()), 1);
  TEST_EQUALITY(int(found.edges[0].size()), 2 * (n - 1));
}

TEUCHOS_UNIT_TEST(ClusterGraph, FourQuartersMeetAtACrossPointThatEndsTheirEdges) {
  const int n = 4;
  const ClusterGraph graph = cellsOf(n);
  std::vector<int> quarters;
  for (int cell = 0; cell < n * n; ++cell) quarters.push_back(2 * (cell / n / (n / 2)) + cell % n / (n / 2));
  const Interfaces found(graph, quarters);
  TEST_EQUALITY(int(found.points.size()), 2 * 5);  // the centre, and the middles of the sides
  TEST_EQUALITY(int(found.edges.size()), 4);
  for (const auto& edge : found.edges) TEST_EQUALITY(int(edge.size()), 2);
}

TEUCHOS_UNIT_TEST(ClusterGraph, SeparateStretchesBetweenTwoClustersAreTwoEdges) {
  const int n = 6;
  const ClusterGraph graph = cellsOf(n);
  std::vector<int> middleAndRest;  // a strip across the square, and the parts on both sides of it
  for (int cell = 0; cell < n * n; ++cell) middleAndRest.push_back(cell / n == 2 || cell / n == 3 ? 1 : 0);
  const Interfaces found(graph, middleAndRest);
  TEST_EQUALITY(int(found.edges.size()), 2);
  TEST_EQUALITY(int(found.points.size()), 2 * 4);
}

TEUCHOS_UNIT_TEST(ClusterGraph, DividesStripsAndLeavesSquaresAlone) {
  const int n = 16;
  const ClusterGraph graph = cellsOf(n);
  const ElementGraph neighbours = fixedNeighbours(graph);
  std::vector<int> clusterOf, row;  // one square of 8 x 8 cells, the others in one-wide columns: of 16 cells, and of 8
  for (const std::vector<int>& unknowns : graph.unknownsOf) {
    Point sum{};
    for (const int unknown : unknowns)
      for (int k = 0; k < 2; ++k) sum[k] += n * graph.unknowns[unknown].point[k] / static_cast<double>(unknowns.size());
    const int x = static_cast<int>(sum[0]), y = static_cast<int>(sum[1]);
    row.push_back(y);
    clusterOf.push_back(x < 8 && y < 8 ? 0 : 1 + x);
  }
  const std::vector<int> before = clusterOf;
  const int clusters = divideSlender(graph, neighbours, 17, clusterOf);
  TEST_EQUALITY(clusters, 9 + 8 * 4);  // 16 : 1 becomes four pieces of 4 : 1; 8 : 1 is not too long
  std::vector<std::set<int>> from(clusters);
  std::vector<int> least(clusters, n), most(clusters, -1), size(clusters, 0);
  for (int cell = 0; cell < n * n; ++cell) {
    const int c = clusterOf[cell];
    from[c].insert(before[cell]);
    least[c] = std::min(least[c], row[cell]);
    most[c] = std::max(most[c], row[cell]);
    ++size[c];
  }
  for (int c = 0; c < clusters; ++c) {
    TEST_EQUALITY(from[c].size(), 1u);
    const int whole = *from[c].begin();
    TEST_EQUALITY(size[c], whole == 0 ? 64 : whole < 9 ? 8 : most[c] - least[c] + 1);  // pieces of a column are connected
    if (whole >= 9) TEST_COMPARE(size[c], <=, 6);
  }
}
