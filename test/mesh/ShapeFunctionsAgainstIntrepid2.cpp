// Shape functions against the bases of Intrepid2, at random points.
#include <Intrepid2_HGRAD_HEX_C1_FEM.hpp>
#include <Intrepid2_HGRAD_HEX_C2_FEM.hpp>
#include <Intrepid2_HGRAD_LINE_C1_FEM.hpp>
#include <Intrepid2_HGRAD_PYR_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C2_FEM.hpp>
#include <Intrepid2_HGRAD_WEDGE_C1_FEM.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <cmath>

#include <mesh/ReferenceCells.hpp>

using namespace suture;

namespace {

namespace i2 = Intrepid2;
using Device = Kokkos::Device<Kokkos::DefaultHostExecutionSpace, Kokkos::HostSpace>;
using Basis = i2::Basis<Device, double, double>;
using Values = Kokkos::DynRankView<double, Device>;

/// A basis with the node of the cell that belongs to each of its functions.
struct NumberedBasis {
  Teuchos::RCP<Basis> basis;
  std::vector<int> nodes;
};

template <typename OneBasis>
NumberedBasis numbered(const std::vector<Point>& places) {
  NumberedBasis made{Teuchos::rcp(new OneBasis), {}};
  const int functions = made.basis->getCardinality(), dimension = static_cast<int>(made.basis->getBaseCellTopology().getDimension());
  Values coordinates("coordinates", functions, dimension);
  made.basis->getDofCoords(coordinates);
  for (int f = 0; f < functions; ++f)
    for (std::size_t node = 0; node < places.size(); ++node) {
      double away = 0;
      for (int k = 0; k < dimension; ++k) away += std::abs(coordinates(f, k) - places[node][k]);
      if (away < 1e-12) made.nodes.push_back(static_cast<int>(node));
    }
  return made;
}

NumberedBasis basisOf(Cell cell) {
  const std::vector<Point> places = referencecells::places(cell);
  switch (cell) {
    case Cell::Triangle3:
      return numbered<i2::Basis_HGRAD_TRI_C1_FEM<Device, double, double>>(places);
    case Cell::Triangle6:
      return numbered<i2::Basis_HGRAD_TRI_C2_FEM<Device, double, double>>(places);
    case Cell::Quadrilateral4:
      return numbered<i2::Basis_HGRAD_QUAD_C1_FEM<Device, double, double>>(places);
    case Cell::Quadrilateral9:
      return numbered<i2::Basis_HGRAD_QUAD_C2_FEM<Device, double, double>>(places);
    case Cell::Tetrahedron4:
      return numbered<i2::Basis_HGRAD_TET_C1_FEM<Device, double, double>>(places);
    case Cell::Tetrahedron10:
      return numbered<i2::Basis_HGRAD_TET_C2_FEM<Device, double, double>>(places);
    case Cell::Hexahedron8:
      return numbered<i2::Basis_HGRAD_HEX_C1_FEM<Device, double, double>>(places);
    case Cell::Hexahedron27:
      return numbered<i2::Basis_HGRAD_HEX_C2_FEM<Device, double, double>>(places);
    case Cell::Wedge6:
      return numbered<i2::Basis_HGRAD_WEDGE_C1_FEM<Device, double, double>>(places);
    case Cell::Pyramid5:
      return numbered<i2::Basis_HGRAD_PYR_C1_FEM<Device, double, double>>(places);
    default:
      return {};
  }
}

/// Values and gradients of a basis at a point, by node.
std::vector<ShapeJet> jetsOf(const NumberedBasis& all, const Point& at) {
  const int functions = all.basis->getCardinality(), dimension = static_cast<int>(all.basis->getBaseCellTopology().getDimension());
  Values points("points", 1, dimension), values("values", functions, 1), gradients("gradients", functions, 1, dimension);
  for (int k = 0; k < dimension; ++k) points(0, k) = at[k];
  all.basis->getValues(values, points, i2::OPERATOR_VALUE);
  all.basis->getValues(gradients, points, i2::OPERATOR_GRAD);
  std::vector<ShapeJet> jets(functions);
  for (int f = 0; f < functions; ++f) {
    jets[all.nodes[f]].value = values(f, 0);
    for (int k = 0; k < dimension; ++k) jets[all.nodes[f]].gradient[k] = gradients(f, 0, k);
  }
  return jets;
}

double difference(const ShapeJet& a, const ShapeJet& b) { return std::abs(a.value - b.value) + norm(minus(a.gradient, b.gradient)); }

const double tolerance = 1e-13;

}  // namespace

TEUCHOS_UNIT_TEST(ShapeFunctionsAgainstIntrepid2, AgreeInEveryCell) {
  std::mt19937 random(7);
  int compared = 0;
  for (const Cell cell : referencecells::all()) {
    const NumberedBasis basis = basisOf(cell);
    if (basis.nodes.empty()) continue;
    ++compared;
    TEST_EQUALITY(static_cast<int>(basis.nodes.size()), cellInfo(cell).nodes);
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Point at = referencecells::inside(cell, random);
      const std::vector<ShapeJet> expected = jetsOf(basis, at), jets = referencecells::jets(cell, at);
      for (std::size_t i = 0; i < jets.size(); ++i) TEST_COMPARE(difference(jets[i], expected[i]), <, tolerance);
    }
  }
  TEST_EQUALITY(compared, kCells - 2);
}

// Intrepid2 13.2 has no functions of 8 and 20 nodes. They are combinations of those of 9 and 27, by their values at these nodes.
TEUCHOS_UNIT_TEST(ShapeFunctionsAgainstIntrepid2, AgreeInCellsWithoutCentres) {
  std::mt19937 random(9);
  for (const auto& [cell, whole] : {std::pair(Cell::Quadrilateral8, Cell::Quadrilateral9), {Cell::Hexahedron20, Cell::Hexahedron27}}) {
    const NumberedBasis basis = basisOf(whole);
    const std::vector<Point> places = referencecells::places(whole);
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Point at = referencecells::inside(cell, random);
      const std::vector<ShapeJet> all = jetsOf(basis, at), jets = referencecells::jets(cell, at);
      std::vector<ShapeJet> expected(jets.size());
      for (std::size_t b = 0; b < places.size(); ++b) {
        const std::vector<ShapeJet> there = referencecells::jets(cell, places[b]);
        for (std::size_t a = 0; a < jets.size(); ++a) {
          expected[a].value += there[a].value * all[b].value;
          expected[a].gradient = plus(expected[a].gradient, scaled(there[a].value, all[b].gradient));
        }
      }
      for (std::size_t a = 0; a < jets.size(); ++a) TEST_COMPARE(difference(jets[a], expected[a]), <, tolerance);
    }
  }
}

// A side of three nodes is the side y = -1 of the square.
TEUCHOS_UNIT_TEST(ShapeFunctionsAgainstIntrepid2, AgreeOnSidesIn2D) {
  const NumberedBasis line = numbered<i2::Basis_HGRAD_LINE_C1_FEM<Device, double, double>>({{-1, 0, 0}, {1, 0, 0}});
  const NumberedBasis square = basisOf(Cell::Quadrilateral9);
  const int onSide[] = {0, 1, 4};
  for (const double xi : {-1.0, -0.7, -0.1, 0.0, 0.4, 1.0}) {
    const std::vector<ShapeJet> two = jetsOf(line, {xi, 0, 0}), nine = jetsOf(square, {xi, -1, 0});
    const SideShape straight = sideShape(2, xi), curved = sideShape(3, xi);
    for (int i = 0; i < 2; ++i)
      TEST_COMPARE(std::abs(straight.value[i] - two[i].value) + std::abs(straight.slope[i] - two[i].gradient[0]), <, tolerance);
    for (int i = 0; i < 3; ++i) {
      const ShapeJet& expected = nine[onSide[i]];
      TEST_COMPARE(std::abs(curved.value[i] - expected.value) + std::abs(curved.slope[i] - expected.gradient[0]), <, tolerance);
    }
  }
}
