// Cells in 3D as tetrahedra: balanced nodal forces, functions on sides with four vertices, numbers of points of quadrature.
#include <Eigen/Dense>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <complex>
#include <random>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SimplexField.hpp>
#include <suture/answer/bound/SolidField.hpp>
#include <suture/answer/bound/SplitSide.hpp>
#include <suture/answer/bound/SplitSolid.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {
namespace {

/// One cell with its vertices moved at random, so that its sides are warped.
CellBlock warpedCell(Cell cell, std::mt19937& random, double most) {
  std::uniform_real_distribution<double> move(-most, most);
  CellBlock block;
  block.dimension = 3;
  block.cells = {cell};
  const CellInfo& info = cellInfo(cell);
  for (int i = 0; i < info.nodes; ++i) {
    const Point p = referencePoint(cell, i);
    for (int k = 0; k < 3; ++k) block.coordinates.push_back(i < info.vertices ? p[k] + move(random) : 0.0);
    block.connectivity.push_back(i);
  }
  block.offsets.push_back(info.nodes);
  ShapeJet jets[8];
  for (int i = info.vertices; i < info.nodes; ++i) {  // the trilinear image
    shapeJets(Cell::Hexahedron8, referencePoint(cell, i), jets);
    for (int v = 0; v < 8; ++v)
      for (int k = 0; k < 3; ++k) block.coordinates[std::size_t(i) * 3 + k] += jets[v].value * block.coordinates[std::size_t(v) * 3 + k];
  }
  return block;
}

Eigen::Matrix<double, 6, 1> resultantsOf(const Eigen::Vector3d& place, const Eigen::Vector3d& force) {
  Eigen::Matrix<double, 6, 1> all;
  all << force, place.cross(force);
  return all;
}

const std::vector<Cell> kSplitCells{Cell::Hexahedron8, Cell::Wedge6, Cell::Pyramid5, Cell::Hexahedron20, Cell::Hexahedron27};

// Each tetrahedron is in balance with its source, and the sums at the nodes are those of the cell.
TEUCHOS_UNIT_TEST(SplitCells, BalanceTheirTetrahedra) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Cell cell : kSplitCells) {
    const CellBlock block = warpedCell(cell, random, 0.15);
    const CellParts<3> parts = cellParts<3>(block, 0);
    const int order = cellInfo(cell).order, count = SimplexNodes<3>::nodes(order);
    const Eigen::Matrix3Xd places = placesOfParts(block, 0, parts);
    std::vector<BoundElement<3>> simplices(parts.parts.size());
    Eigen::Matrix<double, 6, 1> resultant = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t t = 0; t < simplices.size(); ++t) {
      BoundElement<3>& own = simplices[t];
      for (int i = 0; i < 4; ++i) own.places.col(i) = places.col(parts.parts[t].nodes[i]);
      const Eigen::Matrix3d map = own.places.rightCols<3>().colwise() - own.places.col(0);
      TEST_COMPARE(map.determinant() * parts.parts[t].orientation, >, 0.0);
      own.forces = own.forces.NullaryExpr(3, 10, [&] { return any(random); });
      own.sources.setZero();
      for (int i = 0; i < (order == 1 ? 1 : 4); ++i) own.sources.col(i) = Eigen::Vector3d(any(random), any(random), any(random));
      Eigen::Matrix<double, 3, 4> sources = own.sources;
      if (order == 1) sources.colwise() = own.sources.col(0).eval();  // only the first column counts
      const auto ofSource = SimplexField<3>(own.places).forcesOfSources(sources, 1);
      for (int i = 0; i < 4; ++i) resultant += resultantsOf(own.places.col(i), ofSource.col(i));
    }
    // Forces on the nodes of the cell that balance the sources.
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, places.cols());
    Matrix system = Matrix::Zero(6, 3 * places.cols());
    for (int i = 0; i < int(places.cols()); ++i)
      for (int k = 0; k < 3; ++k) system.col(3 * i + k) = resultantsOf(places.col(i), Eigen::Vector3d::Unit(k));
    for (int i = 0; i < int(places.cols()); ++i) {
      const bool isCentre = i >= 20 && i < cellInfo(cell).nodes, isNew = i >= cellInfo(cell).nodes;
      if (isCentre || (isNew && order == 1)) system.middleCols(3 * i, 3).setZero();  // no nodes of tetrahedra
    }
    const Vector found = system.transpose() * (system * system.transpose()).ldlt().solve(-resultant);
    for (int i = 0; i < int(places.cols()); ++i) forces.col(i) = found.segment<3>(3 * i);
    splitForces(parts, forces, places, order, simplices.data());
    Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, places.cols());
    for (std::size_t t = 0; t < simplices.size(); ++t) {
      Eigen::Matrix<double, 6, 1> own = Eigen::Matrix<double, 6, 1>::Zero();
      for (int i = 0; i < count; ++i) {
        sums.col(parts.parts[t].nodes[i]) += simplices[t].forces.col(i);
        own += resultantsOf(places.col(parts.parts[t].nodes[i]), simplices[t].forces.col(i));
      }
      Eigen::Matrix<double, 3, 4> sources = simplices[t].sources;
      if (order == 1) sources.colwise() = simplices[t].sources.col(0).eval();
      const auto ofSource = SimplexField<3>(simplices[t].places).forcesOfSources(sources, 1);
      for (int i = 0; i < 4; ++i) own += resultantsOf(simplices[t].places.col(i), ofSource.col(i));
      TEST_COMPARE(own.norm(), <, 1e-12);
    }
    TEST_COMPARE((sums - forces).norm(), <, 1e-12);
  }
}

// Forces at centres, moved to the middles of diagonals, keep their resultants.
TEUCHOS_UNIT_TEST(SplitCells, MoveForcesOfCentres) {
  std::mt19937 random(5);
  const CellBlock block = warpedCell(Cell::Hexahedron27, random, 0.15);
  const CellParts<3> parts = cellParts<3>(block, 0);
  const Eigen::Matrix3Xd places = placesOfParts(block, 0, parts);
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, places.cols());
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 27; ++i) forces.col(i) = Eigen::Vector3d(any(random), any(random), any(random));
  const auto sum = [&] {
    Eigen::Matrix<double, 6, 1> all = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < int(places.cols()); ++i) all += resultantsOf(places.col(i), forces.col(i));
    return all;
  };
  const Eigen::Matrix<double, 6, 1> before = sum();
  moveCentreForces(Cell::Hexahedron27, parts, places, forces);
  TEST_COMPARE((sum() - before).norm(), <, 1e-12);
  TEST_EQUALITY(forces.middleCols(20, 7).norm(), 0.0);
}

// A constant stress has the same resultants on both sets of nodes of a warped side, a linear one on those of a plane side; the volume
// between the bilinear side and the triangles is the difference between the volumes of the cell and of its tetrahedra.
TEUCHOS_UNIT_TEST(SplitSide, KeepsResultants) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Cell cell : {Cell::Hexahedron8, Cell::Hexahedron20, Cell::Hexahedron27})
    for (const bool plane : {false, true}) {
      CellBlock block = warpedCell(cell, random, plane ? 0.0 : 0.15);
      if (plane) {  // trapezoids
        for (int i = 0; i < block.nodes(); ++i)
          for (int k = 0; k < 2; ++k) block.coordinates[std::size_t(i) * 3 + k] *= 1 + 0.3 * block.coordinates[std::size_t(i) * 3 + 2];
      }
      const CellParts<3> parts = cellParts<3>(block, 0);
      const Eigen::Matrix3Xd places = placesOfParts(block, 0, parts);
      double volume = 0.0, lens = 0.0;
      for (const auto& part : parts.parts) {
        Eigen::Matrix<double, 3, 4> own;
        for (int i = 0; i < 4; ++i) own.col(i) = places.col(part.nodes[i]);
        volume += SimplexField<3>(own).volume();
      }
      const auto& sides = cellInfo(cell).sideNodes;
      for (const std::vector<int>& side : sides) {
        int diagonal = -1, odd = 0;
        for (std::size_t d = 0; d < parts.diagonals.size(); ++d)
          for (int i = 0; i < 2; ++i)
            if (std::minmax(side[std::size_t(i)], side[std::size_t(i) + 2]) == std::minmax(parts.diagonals[d][0], parts.diagonals[d][1]))
              diagonal = int(d), odd = i;
        TEST_ASSERT(diagonal >= 0);
        std::vector<Point> points;
        std::vector<int> nodes = side;
        nodes.push_back(cellInfo(cell).nodes + diagonal);
        for (const int node : side) points.push_back(block.point(node));
        const SplitSide split(points, odd != 0);
        TEST_EQUALITY(split.isPlane(), plane);
        lens += split.lens();
        LinearStress stress = stress.NullaryExpr([&] { return any(random); });
        Eigen::Matrix<double, 6, 1> difference = Eigen::Matrix<double, 6, 1>::Zero(), size = difference;
        for (int i = 0; i < split.nodes(); ++i) {
          difference += resultantsOf(places.col(nodes[i]), SplitSide::force(stress, split.ofCell()[i], plane));
          size += resultantsOf(places.col(nodes[i]), SplitSide::force(stress, split.ofCell()[i], plane)).cwiseAbs();
        }
        for (std::size_t i = 0; i < split.ofTriangles().size(); ++i)
          difference -= resultantsOf(places.col(nodes[i]), SplitSide::force(stress, split.ofTriangles()[i], plane));
        TEST_COMPARE(difference.norm(), <, 1e-12 * size.norm());
      }
      SolidField field(block, 0);
      field.set(SolidField::Nodal::Zero(3, block.nodes()));
      field.integrals(Eigen::Matrix<double, 6, 6>::Identity(), nullptr);
      TEST_COMPARE(std::abs(field.volume() - volume - lens), <, 1e-12);
      if (!plane) TEST_COMPARE(std::abs(lens), >, 1e-3);
    }
}

// No zero of a polynomial with such coefficients is inside the ellipse, and some are near it.
TEUCHOS_UNIT_TEST(SolidField, KnowsTheEllipseWithoutZeros) {
  std::mt19937 random(11);
  for (const double k : {1.05, 1.5, 4.0, 50.0}) {
    std::uniform_real_distribution<double> any(0, 1);
    double least = HUGE_VAL;
    for (int trial = 0; trial < 20000; ++trial) {
      double b[3];
      for (double& own : b) {
        const double at = any(random);
        own = at < 0.3 ? 1.0 : at > 0.7 ? k : 1 + (k - 1) * any(random);
      }
      // b0 + 2 b1 z + b2 z^2 = 0, t = (z - 1) / (z + 1)
      const std::complex<double> root = std::sqrt(std::complex<double>(b[1] * b[1] - b[0] * b[2], 0.0));
      for (const std::complex<double>& z : {(-b[1] + root) / b[2], (-b[1] - root) / b[2]}) {
        const std::complex<double> t = (z - 1.0) / (z + 1.0), s = std::sqrt(t * t - 1.0);
        least = std::min(least, std::max(std::abs(t + s), std::abs(t - s)));
      }
    }
    out << k << ": " << rateOf(k) << ", found " << least << "\n";
    TEST_COMPARE(rateOf(k), <=, least * (1 + 1e-9));
    TEST_COMPARE(rateOf(k), >, 0.5 * least);
  }
}

}  // namespace
}  // namespace suture
