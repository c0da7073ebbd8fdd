#include <suture/reader/gmsh/FlatTriangles.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace {

using suture::GmshMesh;

constexpr double kRoundOff = 3e-17;

struct Edges {
  std::set<std::pair<int, int>> ends;
  std::map<int, std::set<std::pair<int, int>>> ofMiddle;
};

/// Edges of the triangles of a block, and for the second order the ends of the edges of each mid-side node.
Edges edgesOf(const GmshMesh::Block& block, int nodes) {
  Edges edges;
  for (std::size_t e = 0; e < block.nodes.size() / nodes; ++e)
    for (int k = 0; k < 3; ++k) {
      const int a = block.nodes[nodes * e + k], b = block.nodes[nodes * e + (k + 1) % 3];
      edges.ends.insert(std::minmax(a, b));
      if (nodes == 6) edges.ofMiddle[block.nodes[nodes * e + 3 + k]].insert(std::minmax(a, b));
    }
  return edges;
}

double areaOf(const GmshMesh& mesh, const int* corners) {
  const auto at = [&](int k) { return &mesh.coordinates[3 * static_cast<std::size_t>(corners[k])]; };
  const double *a = at(0), *b = at(1), *c = at(2);
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/// A square of two triangles above three that fill the round-off between its lower side and two nodes on this side:
///   4 ------- 3
///   |       / |
///   0 -1--2-- 5   with the flat triangles (0, 1, 2) and (0, 2, 5) below the edge (0, 5), their orders as `reversed` says
GmshMesh square(int nodes, bool reversed) {
  GmshMesh mesh;
  mesh.coordinates = {0, 0, 0, 1. / 3, -kRoundOff, 0, 2. / 3, -kRoundOff, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0};
  std::vector<int> corners{0, 5, 3, 0, 3, 4, 0, 1, 2, 0, 2, 5};
  if (reversed) corners = {0, 5, 3, 0, 3, 4, 0, 2, 1, 5, 2, 0};
  GmshMesh::Block block;
  block.dimension = 2, block.tag = 1, block.type = nodes == 3 ? 2 : 9;
  std::map<std::pair<int, int>, int> middles;
  for (std::size_t e = 0; e < corners.size() / 3; ++e) {
    block.nodes.insert(block.nodes.end(), corners.begin() + 3 * e, corners.begin() + 3 * e + 3);
    for (int k = 0; k < 3 && nodes == 6; ++k) {
      const int a = corners[3 * e + k], b = corners[3 * e + (k + 1) % 3];
      const auto [at, isNew] = middles.emplace(std::minmax(a, b), 6 + static_cast<int>(middles.size()));
      if (isNew)
        for (int d = 0; d < 3; ++d) mesh.coordinates.push_back(0.5 * (mesh.coordinates[3 * a + d] + mesh.coordinates[3 * b + d]));
      block.nodes.push_back(at->second);
    }
  }
  for (std::size_t node = 0; 3 * node < mesh.coordinates.size(); ++node) mesh.tags.push_back(node + 1);
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

TEUCHOS_UNIT_TEST(FlatTriangles, AreReplacedBySwapsOfEdges) {
  for (const int nodes : {3, 6})
    for (const bool reversed : {false, true}) {
      GmshMesh mesh = square(nodes, reversed);
      const int swapped = suture::swapFlatTriangles(mesh);
      TEST_EQUALITY(swapped, 2);
      const GmshMesh::Block& block = mesh.blocks[0];
      double all = 0;
      for (std::size_t e = 0; e < 4; ++e) {
        const double area = areaOf(mesh, &block.nodes[nodes * e]);
        TEST_COMPARE(area, >, 0.1);
        all += area;
      }
      TEST_FLOATING_EQUALITY(all, 1.0, 1e-14);
      const Edges edges = edgesOf(block, nodes);
      const std::set<std::pair<int, int>> expected{{0, 1}, {1, 2}, {2, 5}, {3, 5}, {3, 4}, {0, 4}, {0, 3}, {1, 3}, {2, 3}};
      TEST_ASSERT(edges.ends == expected);
      for (const auto& [middle, ends] : edges.ofMiddle) {
        TEST_EQUALITY(ends.size(), 1u);  // one edge for each mid-side node
        for (int d = 0; d < 3; ++d)
          TEST_COMPARE(std::abs(mesh.coordinates[3 * middle + d] -
                                0.5 * (mesh.coordinates[3 * ends.begin()->first + d] + mesh.coordinates[3 * ends.begin()->second + d])),
                       <, 1e-15);
      }
    }
}

TEUCHOS_UNIT_TEST(FlatTriangles, SoundTrianglesStay) {
  GmshMesh mesh = square(3, false);
  for (const std::size_t node : {1, 2}) mesh.coordinates[3 * node + 1] = -1e-4;
  const std::vector<int> before = mesh.blocks[0].nodes;
  const int swapped = suture::swapFlatTriangles(mesh);
  TEST_EQUALITY(swapped, 0);
  TEST_ASSERT(mesh.blocks[0].nodes == before);
}

TEUCHOS_UNIT_TEST(FlatTriangles, OfOtherSurfacesStay) {
  GmshMesh mesh = square(3, false);  // the edge (0, 5) lies between two parts
  mesh.blocks[0].parts = {1, 1, 2, 2};
  const int swapped = suture::swapFlatTriangles(mesh);
  TEST_EQUALITY(swapped, 0);
}

}  // namespace
