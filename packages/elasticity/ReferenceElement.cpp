// The only source that includes Intrepid2.
#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Intrepid2_HGRAD_QUAD_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C2_FEM.hpp>
#include <Kokkos_Core.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

namespace suture {
namespace {

using Device = Kokkos::Device<Kokkos::DefaultHostExecutionSpace, Kokkos::HostSpace>;
using Basis = Intrepid2::Basis<Device, double, double>;
using Values = Kokkos::DynRankView<double, Device>;

struct Shape {
  Teuchos::RCP<Basis> basis;
  shards::CellTopology topology;
  int order;
  bool triangle;
};

Shape shapeOf(Cell cell) {
  const shards::CellTopology triangle(shards::getCellTopologyData<shards::Triangle<3>>());
  const shards::CellTopology quadrilateral(shards::getCellTopologyData<shards::Quadrilateral<4>>());
  switch (cell) {
    case Cell::Triangle3:
      return {Teuchos::rcp(new Intrepid2::Basis_HGRAD_TRI_C1_FEM<Device, double, double>), triangle, 1, true};
    case Cell::Triangle6:
      return {Teuchos::rcp(new Intrepid2::Basis_HGRAD_TRI_C2_FEM<Device, double, double>), triangle, 2, true};
    case Cell::Quadrilateral4:
      return {Teuchos::rcp(new Intrepid2::Basis_HGRAD_QUAD_C1_FEM<Device, double, double>), quadrilateral, 1, false};
    case Cell::Quadrilateral8:  // a subspace of that of 9 nodes, see withoutCentre()
    case Cell::Quadrilateral9:
      return {Teuchos::rcp(new Intrepid2::Basis_HGRAD_QUAD_C2_FEM<Device, double, double>), quadrilateral, 2, false};
  }
  throw InternalError("no reference element for a cell of kind " + std::to_string(static_cast<int>(cell)));
}

// The cubature's degree is that of the polynomials on a triangle, and of each direction on a quadrilateral.
int degreeOf(const Shape& shape, Rule rule) {
  switch (rule) {
    case Rule::Stiffness:
      return shape.triangle ? std::max(1, 2 * (shape.order - 1)) : 2 * shape.order;
    case Rule::Load:
      // A quadrilateral's Jacobian, and that of a curved triangle, are of the order of the map.
      // In axisymmetric blocks the radius comes on top.
      return shape.triangle ? (shape.order == 1 ? 2 : 6) : 2 * shape.order + 1;
    case Rule::Centroid:
      return 1;
    case Rule::Data:
      return 2 * shape.order + 4;
    case Rule::Sampling:
      return shape.order == 1 ? 1 : shape.triangle ? 2 : 3;
    case Rule::Recovery:
      return 2 * shape.order;
    case Rule::Revolution:
      return shape.triangle ? 2 * shape.order : 2 * shape.order + 1;
  }
  throw InternalError("no such quadrature rule");
}

struct Cubature {
  Values points, weights;
};

Cubature cubatureOf(const shards::CellTopology& topology, int degree) {
  const auto cubature = Intrepid2::DefaultCubatureFactory::create<Device, double, double>(topology, degree);
  Cubature all{Values("points", cubature->getNumPoints(), cubature->getDimension()), Values("weights", cubature->getNumPoints())};
  cubature->getCubature(all.points, all.weights);
  return all;
}

void requireKokkos() {
  if (!Kokkos::is_initialized())
    throw InternalError("Kokkos is not initialised: a program that uses elements needs a Tpetra::ScopeGuard in its main()");
}

ReferenceElement tabulate(const Basis& basis, const Values& points, const Values& weights) {
  const int nodes = basis.getCardinality(), count = static_cast<int>(points.extent(0)), dimension = 2;
  Values values("values", nodes, count), gradients("gradients", nodes, count, dimension);
  basis.getValues(values, points, Intrepid2::OPERATOR_VALUE);
  basis.getValues(gradients, points, Intrepid2::OPERATOR_GRAD);
  ReferenceElement table;
  table.nodes = nodes;
  table.points = count;
  table.dimension = dimension;
  for (int q = 0; q < count; ++q) {
    table.weights.push_back(weights(q));
    for (int a = 0; a < nodes; ++a) {
      table.values.push_back(values(a, q));
      for (int k = 0; k < dimension; ++k) table.gradients.push_back(gradients(a, q, k));
    }
  }
  return table;
}

// The serendipity functions of 8 nodes are in the space of the 9: N8_a = N9_a + N8_a(centre) N9_centre, with -1/4 at the centre for
// vertices and 1/2 for mid-side nodes. (Intrepid2 13.2 has no serendipity basis.)
ReferenceElement withoutCentre(const ReferenceElement& nine) {
  ReferenceElement eight = nine;
  eight.nodes = 8;
  eight.values.clear();
  eight.gradients.clear();
  for (int q = 0; q < nine.points; ++q)
    for (int a = 0; a < 8; ++a) {
      const double share = a < 4 ? -0.25 : 0.5;
      eight.values.push_back(nine.valuesAt(q)[a] + share * nine.valuesAt(q)[8]);
      for (int k = 0; k < 2; ++k) eight.gradients.push_back(nine.gradientsAt(q)[2 * a + k] + share * nine.gradientsAt(q)[16 + k]);
    }
  return eight;
}

ReferenceElement makeElement(Cell cell, Rule rule) {
  requireKokkos();
  const Shape shape = shapeOf(cell);
  const Cubature cubature = cubatureOf(shape.topology, degreeOf(shape, rule));
  const ReferenceElement table = tabulate(*shape.basis, cubature.points, cubature.weights);
  return cell == Cell::Quadrilateral8 ? withoutCentre(table) : table;
}

// All our cells have the same trace on a side: that of the square on its side y = -1, whose nodes are 0, 1 and, of order 2, 4.
ReferenceElement makeSide(int nodes, Rule rule) {
  requireKokkos();
  const Shape square = shapeOf(nodes == 2 ? Cell::Quadrilateral4 : Cell::Quadrilateral9);
  // A constant traction on a curved side has the square root of a polynomial in its integrand: two points more than a straight one needs.
  const int degree = (nodes == 2 ? 3 : 7) + (rule == Rule::Data ? 4 : 0);
  const Cubature cubature = cubatureOf(shards::CellTopology(shards::getCellTopologyData<shards::Line<2>>()), degree);
  const int count = static_cast<int>(cubature.weights.extent(0));
  Values points("points", count, 2);
  for (int q = 0; q < count; ++q) {
    points(q, 0) = cubature.points(q, 0);
    points(q, 1) = -1.0;
  }
  const ReferenceElement whole = tabulate(*square.basis, points, cubature.weights);
  ReferenceElement side;
  side.nodes = nodes;
  side.points = count;
  side.dimension = 1;
  side.weights = whole.weights;
  const std::array<int, 3> onSide{0, 1, 4};
  for (int q = 0; q < count; ++q)
    for (int a = 0; a < nodes; ++a) {
      side.values.push_back(whole.valuesAt(q)[onSide[a]]);
      side.gradients.push_back(whole.gradientsAt(q)[2 * onSide[a]]);
    }
  return side;
}

constexpr int cellKinds = 5, rules = 7;
using Tables = std::array<std::array<ReferenceElement, rules>, cellKinds>;

Tables makeTables() {
  Tables all;
  for (int c = 0; c < cellKinds; ++c)
    for (int r = 0; r < rules; ++r) all[c][r] = makeElement(static_cast<Cell>(c), static_cast<Rule>(r));
  return all;
}

}  // namespace

const ReferenceElement& referenceElement(Cell cell, Rule rule) {
  static const Tables tables = makeTables();  // plain vectors: they outlive Kokkos
  return tables.at(static_cast<int>(cell)).at(static_cast<int>(rule));
}

const ReferenceElement& referenceSide(int nodes, Rule rule) {
  static const std::array<ReferenceElement, 4> sides{makeSide(2, Rule::Load), makeSide(3, Rule::Load), makeSide(2, Rule::Data),
                                                     makeSide(3, Rule::Data)};
  if (nodes != 2 && nodes != 3) throw InternalError("a side of " + std::to_string(nodes) + " nodes");
  return sides[nodes - 2 + (rule == Rule::Data ? 2 : 0)];
}

}  // namespace suture
