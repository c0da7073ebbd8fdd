#include <suture/mesh/CellGeometry.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

using namespace suture;

namespace {

const Cell all[] = {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9};

// The reference cell under x -> A x + b, with vertices as VTK has them and mid nodes in the middle.
CellBlock affine(Cell cell, double a, double b, double c, double d) {
  const CellInfo& info = cellInfo(cell);
  std::vector<Point> reference;
  if (info.vertices == 3)
    reference = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  else
    reference = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (int s = 0; info.nodes > info.vertices && s < info.vertices; ++s) {
    const Point& p = reference[s];
    const Point& q = reference[(s + 1) % info.vertices];
    reference.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0});
  }
  if (info.nodes == 9) reference.push_back({0, 0, 0});
  CellBlock block;
  for (int i = 0; i < info.nodes; ++i) {
    block.coordinates.push_back(a * reference[i][0] + b * reference[i][1] + 7);
    block.coordinates.push_back(c * reference[i][0] + d * reference[i][1] - 3);
    block.connectivity.push_back(i);
  }
  block.cells = {cell};
  block.offsets = {0, info.nodes};
  return block;
}

}  // namespace

TEUCHOS_UNIT_TEST(CellGeometry, HasTheDeterminantOfAnAffineMapInEveryCell) {
  for (const Cell cell : all) {
    TEST_EQUALITY(static_cast<int>(affine(cell, 2, 1, 0.5, 3).nodesOf(0).size()), cellInfo(cell).nodes);
    TEST_FLOATING_EQUALITY(smallestJacobian(affine(cell, 2, 1, 0.5, 3), 0), 2 * 3 - 1 * 0.5, 1e-13);
    TEST_FLOATING_EQUALITY(smallestJacobian(affine(cell, 2, 1, 0.5, -3), 0), -2 * 3 - 1 * 0.5, 1e-13);
    TEST_COMPARE(std::abs(smallestJacobian(affine(cell, 2, 1, 4, 2), 0)), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, MeasuresTheAreaOfTheVertices) {
  for (const Cell cell : all) {
    const double reference = cellInfo(cell).vertices == 3 ? 0.5 : 4;
    TEST_FLOATING_EQUALITY(signedArea(affine(cell, 2, 1, 0.5, 3), 0), 5.5 * reference, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, SeesAMidSideNodeThatFoldsTheElement) {
  CellBlock block = affine(Cell::Triangle6, 1, 0, 0, 1);
  TEST_COMPARE(smallestJacobian(block, 0), >, 0.9);
  block.coordinates[2 * 3] = 7 + 0.8;  // the middle of the first side, beyond three quarters of it
  TEST_COMPARE(smallestJacobian(block, 0), <, -0.1);
}

TEUCHOS_UNIT_TEST(CellGeometry, SeesAQuadrilateralThatIsNotConvex) {
  CellBlock block = affine(Cell::Quadrilateral4, 1, 0, 0, 1);
  block.coordinates[4] = 7 - 0.5, block.coordinates[5] = -3 - 0.5;  // the upper right corner, pulled across the diagonal
  TEST_COMPARE(signedArea(block, 0), >, 0);
  TEST_COMPARE(smallestJacobian(block, 0), <, 0);
}

TEUCHOS_UNIT_TEST(Cell, SidesRunRoundTheCellWithTheBodyOnTheLeft) {
  for (const Cell cell : all) {
    const CellBlock block = affine(cell, 2, 1, 0.5, 3);
    const Point centre = centreOf(block, 0);
    const int sides = static_cast<int>(cellInfo(cell).sideNodes.size());
    for (int s = 0; s < sides; ++s) {
      const std::vector<int> nodes = block.nodesOf(Side{0, s});
      TEST_EQUALITY(nodes[1], block.nodesOf(Side{0, (s + 1) % sides})[0]);
      const Point a = block.point(nodes[0]), b = block.point(nodes[1]);
      TEST_COMPARE((b[0] - a[0]) * (centre[1] - a[1]) - (b[1] - a[1]) * (centre[0] - a[0]), >, 0);
      if (nodes.size() != 3) continue;
      const Point m = block.point(nodes[2]);
      TEST_COMPARE(std::hypot(m[0] - (a[0] + b[0]) / 2, m[1] - (a[1] + b[1]) / 2), <, 1e-14);
    }
  }
}
