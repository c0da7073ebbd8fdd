#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/cut/MetisCut.hpp>

#include "Scenes.hpp"

using namespace suture;

namespace {

Mesh brick(Cell cell, int nx, int ny, int nz) {
  Box box = partitiontesting::box("body", 0, 1, 0, 1, nx, ny);
  box.cell = cell;
  box.z0 = 0;
  box.z1 = 0.5;
  box.nz = nz;
  return partitiontesting::mesh({box});
}

/// Rotated about an oblique axis: no plane of the mesh is normal to a coordinate axis.
void turn(Mesh& mesh) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += 3) {
    const double x = mesh.coordinates[i], y = mesh.coordinates[i + 1], z = mesh.coordinates[i + 2];
    const double u = c * x - s * y, v = s * x + c * y;
    mesh.coordinates[i] = u, mesh.coordinates[i + 1] = c * v - s * z, mesh.coordinates[i + 2] = s * v + c * z;
  }
}

/// True if each part consists of all elements of a box of the grid; they are numbered along x, then y, then z.
bool areBricks(const std::vector<int>& partOf, int parts, int nx, int ny) {
  for (int part = 0; part < parts; ++part) {
    std::array<int, 3> low{1 << 20, 1 << 20, 1 << 20}, high{-1, -1, -1};
    int count = 0;
    for (int e = 0; e < static_cast<int>(partOf.size()); ++e) {
      if (partOf[e] != part) continue;
      const int at[] = {e % nx, e / nx % ny, e / nx / ny};
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
      ++count;
    }
    if (count != (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1)) return false;
  }
  return true;
}

}  // namespace

TEUCHOS_UNIT_TEST(BisectionInSpace, CutsStructuredMeshesIntoBricks) {
  Mesh mesh = brick(Cell::Hexahedron8, 16, 12, 8);
  for (const bool turned : {false, true}) {
    if (turned) turn(mesh);
    const ElementGraph graph = elementGraph(mesh);
    for (const int parts : {2, 3, 8, 13, 24}) {
      const std::vector<int> partOf = metisCut(graph, parts, 1);
      TEST_ASSERT(areBricks(partOf, parts, 16, 12));
      for (int part = 0; part < parts; ++part) {
        const auto size = std::count(partOf.begin(), partOf.end(), part);
        TEST_COMPARE(size, >, 0.75 * 1536 / parts);
        TEST_COMPARE(size, <, 1.3 * 1536 / parts);
      }
    }
  }
}

TEUCHOS_UNIT_TEST(BisectionInSpace, CutsTetrahedraAsWellAsMetisDoes) {
  const Mesh mesh = brick(Cell::Tetrahedron4, 10, 10, 5);
  const ElementGraph graph = elementGraph(mesh);
  ElementGraph plain = graph;
  plain.centres.clear();  // as in 2D
  const auto sides = [&](const std::vector<int>& partOf) {
    int cut = 0;
    for (int e = 0; e < graph.elements(); ++e)
      for (const int other : graph.of(e)) cut += partOf[other] != partOf[e];
    return cut / 2;
  };
  for (const int parts : {8, 20}) {
    const std::vector<int> partOf = metisCut(graph, parts, 1);
    // METIS' k-way method refines all parts at once, which bisection cannot.
    TEST_COMPARE(sides(partOf), <, 1.2 * sides(metisCut(plain, parts, 1)));
    TEST_EQUALITY(components(graph, partOf).count(), parts);
  }
}
