#include <Teuchos_UnitTestHarness.hpp>
#include <suture/constraints/BoundaryLine.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

TEUCHOS_UNIT_TEST(BoundaryLine, HasTributaryAreasOfTheWholeCircleInAxisymmetricMeshes) {
  const double pi = std::acos(-1.0);
  for (Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral8}) {
    Mesh mesh = stack(1, 8, cell);
    moveAll(mesh, [](Point p) -> Point { return {p[0], p[1] + 0.75 * p[0], 0}; });  // the bottom becomes a cone of slant 5, radius 4
    makeAxisymmetric(mesh);
    const BoundaryLine line(mesh, mesh.sideGroups.at("b0_bottom"));
    double area = 0;
    for (const auto& [node, data] : line.nodes()) area += data.tributary;
    TEST_FLOATING_EQUALITY(area, pi * 4 * 5, 1e-13);
    if (cell != Cell::Triangle3) continue;
    // On the axis the cone of height one of its hat function: pi r s / 3; at the rim by the same integral.
    const double h = 0.5, slant = 0.625;
    TEST_FLOATING_EQUALITY(line.at(nodeAt(mesh, 0, 0, 0)).tributary, pi * h * slant / 3, 1e-13);
    TEST_FLOATING_EQUALITY(line.at(nodeAt(mesh, 0, 4, 3)).tributary, pi * slant * (4 - h / 3), 1e-13);
    TEST_FLOATING_EQUALITY(line.at(nodeAt(mesh, 0, 1, 0.75)).tributary, 2 * pi * slant * 1.0, 1e-13);
  }
}
