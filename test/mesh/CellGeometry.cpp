#include <suture/mesh/CellGeometry.hpp>

#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <random>

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

// The map as polynomials s^i t^j through its nodes, and the least of its determinant on a fine grid: nothing of it from the code.
struct Sampled {
  double least = 1e300, leastAtNodes = 1e300;
  Point place{0, 0, 0};

  explicit Sampled(const CellBlock& block) {
    const CellInfo& info = cellInfo(block.cells[0]);
    const bool triangle = info.vertices == 3;
    std::vector<std::array<int, 2>> powers{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}};
    if (info.nodes > 6) powers.push_back({2, 1}), powers.push_back({1, 2});
    if (info.nodes > 8) powers.push_back({2, 2});
    std::vector<std::array<double, 2>> reference{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
    if (triangle) reference = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    Matrix values(info.nodes, info.nodes), x(info.nodes, 2);
    for (int i = 0; i < info.nodes; ++i) {
      for (int k = 0; k < info.nodes; ++k) values(i, k) = std::pow(reference[i][0], powers[k][0]) * std::pow(reference[i][1], powers[k][1]);
      x.row(i) << block.point(i)[0], block.point(i)[1];
    }
    const Matrix c = values.fullPivLu().solve(x);
    const auto visit = [&](double s, double t, double& smallest) {
      Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
      Point p{0, 0, 0};
      for (int k = 0; k < info.nodes; ++k) {
        const int a = powers[k][0], b = powers[k][1];
        for (int d = 0; d < 2; ++d) {
          p[d] += c(k, d) * std::pow(s, a) * std::pow(t, b);
          if (a > 0) jacobian(d, 0) += c(k, d) * a * std::pow(s, a - 1) * std::pow(t, b);
          if (b > 0) jacobian(d, 1) += c(k, d) * b * std::pow(s, a) * std::pow(t, b - 1);
        }
      }
      if (jacobian.determinant() < smallest) smallest = jacobian.determinant(), place = p;
    };
    for (int i = 0; i < info.nodes; ++i) visit(reference[i][0], reference[i][1], leastAtNodes);
    const int n = 50;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= (triangle ? n - i : n); ++j)
        visit(triangle ? double(i) / n : 2.0 * i / n - 1, triangle ? double(j) / n : 2.0 * j / n - 1, least);
  }
};

TEUCHOS_UNIT_TEST(CellGeometry, FindsTheLeastDeterminantOfCurvedElementsBetweenTheirNodes) {
  std::mt19937 random(1);
  for (const Cell cell : {Cell::Triangle6, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    int hidden = 0;  // elements that are sound at all nodes and folded between them
    for (int k = 0; k < 300; ++k) {
      CellBlock block = affine(cell, 1, 0, 0, 1);
      for (double& x : block.coordinates) x += (random() / 4294967296.0 - 0.5) * 0.8;
      const Sampled sampled(block);
      Point place;
      const double least = smallestJacobian(block, 0, &place);
      TEST_COMPARE(std::abs(least - sampled.least), <, 0.02);
      TEST_COMPARE(std::hypot(place[0] - sampled.place[0], place[1] - sampled.place[1]), <, 0.1);
      hidden += sampled.leastAtNodes > 0 && least < 0 && sampled.least < 0;
    }
    out << cellInfo(cell).name << ": " << hidden << " of 300 folded between sound nodes\n";
    TEST_COMPARE(hidden, >, 0);
  }
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
