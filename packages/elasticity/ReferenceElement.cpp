// The only source that includes Intrepid2.
#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Intrepid2_HGRAD_HEX_C1_FEM.hpp>
#include <Intrepid2_HGRAD_HEX_C2_FEM.hpp>
#include <Intrepid2_HGRAD_PYR_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C2_FEM.hpp>
#include <Intrepid2_HGRAD_WEDGE_C1_FEM.hpp>
#include <Kokkos_Core.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>

namespace suture {
namespace {

using Device = Kokkos::Device<Kokkos::DefaultHostExecutionSpace, Kokkos::HostSpace>;
using Basis = Intrepid2::Basis<Device, double, double>;
using Values = Kokkos::DynRankView<double, Device>;

struct Shape {
  Teuchos::RCP<Basis> basis;
  shards::CellTopology topology;
  Cell whole;  // the cell with the complete basis
};

template <typename OneBasis, typename Topology>
Shape shapeOf(Cell whole) {
  return {Teuchos::rcp(new OneBasis), shards::CellTopology(shards::getCellTopologyData<Topology>()), whole};
}

Shape shapeOf(Cell cell) {
  switch (cell) {
    case Cell::Triangle3:
      return shapeOf<Intrepid2::Basis_HGRAD_TRI_C1_FEM<Device, double, double>, shards::Triangle<3>>(cell);
    case Cell::Triangle6:
      return shapeOf<Intrepid2::Basis_HGRAD_TRI_C2_FEM<Device, double, double>, shards::Triangle<3>>(cell);
    case Cell::Quadrilateral4:
      return shapeOf<Intrepid2::Basis_HGRAD_QUAD_C1_FEM<Device, double, double>, shards::Quadrilateral<4>>(cell);
    case Cell::Quadrilateral8:
    case Cell::Quadrilateral9:
      return shapeOf<Intrepid2::Basis_HGRAD_QUAD_C2_FEM<Device, double, double>, shards::Quadrilateral<4>>(Cell::Quadrilateral9);
    case Cell::Tetrahedron4:
      return shapeOf<Intrepid2::Basis_HGRAD_TET_C1_FEM<Device, double, double>, shards::Tetrahedron<4>>(cell);
    case Cell::Tetrahedron10:
      return shapeOf<Intrepid2::Basis_HGRAD_TET_C2_FEM<Device, double, double>, shards::Tetrahedron<4>>(cell);
    case Cell::Hexahedron8:
      return shapeOf<Intrepid2::Basis_HGRAD_HEX_C1_FEM<Device, double, double>, shards::Hexahedron<8>>(cell);
    case Cell::Hexahedron20:
    case Cell::Hexahedron27:
      return shapeOf<Intrepid2::Basis_HGRAD_HEX_C2_FEM<Device, double, double>, shards::Hexahedron<8>>(Cell::Hexahedron27);
    case Cell::Wedge6:
      return shapeOf<Intrepid2::Basis_HGRAD_WEDGE_C1_FEM<Device, double, double>, shards::Wedge<6>>(cell);
    case Cell::Pyramid5:
      return shapeOf<Intrepid2::Basis_HGRAD_PYR_C1_FEM<Device, double, double>, shards::Pyramid<5>>(cell);
  }
  throw InternalError("no reference element for a cell of kind " + std::to_string(static_cast<int>(cell)));
}

// Degree of a rule of loads: for a shape function times the determinant of the map, in 2D times the radius.
int loadDegree(Cell cell, int order) {
  if (dimensionOf(cell) == 2) return isSimplex(cell) ? (order == 1 ? 2 : 6) : 2 * order + 1;
  if (cell == Cell::Wedge6) return 4;  // 3 would suffice, but that rule has a negative weight on triangles
  return isSimplex(cell) ? (order == 1 ? 2 : 5) : 4 * order - 1;
}

int degreeOf(Cell cell, Rule rule) {
  const int order = cellInfo(cell).order;
  switch (rule) {
    case Rule::Stiffness:
      return isSimplex(cell) ? std::max(1, 2 * (order - 1)) : 2 * order;
    case Rule::Load:
      return loadDegree(cell, order);
    case Rule::Centroid:
      return 1;
    case Rule::Data:  // rules beyond degree 6 have negative weights on tetrahedra
      return cell == Cell::Tetrahedron10 ? 6 : 2 * order + 4;
    case Rule::Sampling:
      return order == 1 ? 1 : isSimplex(cell) ? 2 : 3;
    case Rule::Recovery:
      return 2 * order;
    case Rule::Revolution:
      return isSimplex(cell) ? 2 * order : 2 * order + 1;
  }
  throw InternalError("unknown quadrature rule");
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
    throw InternalError("Kokkos is not initialised: programs that use elements need a Tpetra::ScopeGuard in main()");
}

// Basis number of each of a cell's nodes. The basis numbers edges and faces differently, but provides the node positions.
std::vector<int> numbersIn(const Basis& basis, Cell cell) {
  const int nodes = basis.getCardinality(), dimension = cellInfo(cell).dimension;
  Values places("places", nodes, dimension);
  basis.getDofCoords(places);
  std::vector<int> numbers;
  for (int a = 0; a < nodes; ++a) {
    const Point wanted = referencePoint(cell, a);
    for (int b = 0; b < nodes; ++b) {
      double distance = 0.0;
      for (int k = 0; k < dimension; ++k) distance += std::abs(places(b, k) - wanted[k]);
      if (distance < 1e-12) numbers.push_back(b);
    }
  }
  if (static_cast<int>(numbers.size()) != nodes) throw InternalError("the basis of " + cellInfo(cell).name + " has different nodes");
  return numbers;
}

ReferenceElement tabulate(const Shape& shape, const Values& points, const Values& weights) {
  const std::vector<int> numbers = numbersIn(*shape.basis, shape.whole);
  const int nodes = static_cast<int>(numbers.size()), count = static_cast<int>(points.extent(0));
  const int dimension = cellInfo(shape.whole).dimension;
  Values values("values", nodes, count), gradients("gradients", nodes, count, dimension);
  shape.basis->getValues(values, points, Intrepid2::OPERATOR_VALUE);
  shape.basis->getValues(gradients, points, Intrepid2::OPERATOR_GRAD);
  ReferenceElement table;
  table.nodes = nodes;
  table.points = count;
  table.dimension = dimension;
  for (int q = 0; q < count; ++q) {
    table.weights.push_back(weights(q));
    for (int k = 0; k < dimension; ++k) table.places.push_back(points(q, k));
    for (const int a : numbers) {
      table.values.push_back(values(a, q));
      for (int k = 0; k < dimension; ++k) table.gradients.push_back(gradients(a, q, k));
    }
  }
  return table;
}

// The serendipity functions of 8 and 20 nodes lie in the span of the 9 and 27: S_a = N_a + sum of S_a(position of b) N_b over the nodes b
// that the cell lacks. (Intrepid2 13.2 has no serendipity basis.)
ReferenceElement serendipity(const ReferenceElement& all, Cell whole, Cell cell) {
  ReferenceElement own = all;
  own.nodes = cellInfo(cell).nodes;
  own.values.clear();
  own.gradients.clear();
  const int dimension = all.dimension;
  const auto share = [&](int a, int b) { return shapeFunction(cell, a, referencePoint(whole, b)); };
  for (int q = 0; q < all.points; ++q)
    for (int a = 0; a < own.nodes; ++a) {
      double value = all.valuesAt(q)[a];
      for (int b = own.nodes; b < all.nodes; ++b) value += share(a, b) * all.valuesAt(q)[b];
      own.values.push_back(value);
      for (int k = 0; k < dimension; ++k) {
        double slope = all.gradientsAt(q)[dimension * a + k];
        for (int b = own.nodes; b < all.nodes; ++b) slope += share(a, b) * all.gradientsAt(q)[dimension * b + k];
        own.gradients.push_back(slope);
      }
    }
  return own;
}

ReferenceElement makeElement(Cell cell, int degree) {
  requireKokkos();
  const Shape shape = shapeOf(cell);
  const Cubature cubature = cubatureOf(shape.topology, degree);
  const ReferenceElement table = tabulate(shape, cubature.points, cubature.weights);
  return shape.whole == cell ? table : serendipity(table, shape.whole, cell);
}

// In 2D all our cells have the same trace on a side: that of the square on its side y = -1, with nodes 0, 1 and, for order 2, 4.
ReferenceElement makeSide(int nodes, Rule rule) {
  requireKokkos();
  if (nodes != 2 && nodes != 3) throw InternalError("a side of " + std::to_string(nodes) + " nodes");
  const Shape square = shapeOf(nodes == 2 ? Cell::Quadrilateral4 : Cell::Quadrilateral9);
  // A constant traction on a curved side has the square root of a polynomial in its integrand: uses two points more than a straight side.
  const int degree = (nodes == 2 ? 3 : 7) + (rule == Rule::Data ? 4 : 0);
  const Cubature cubature = cubatureOf(shards::CellTopology(shards::getCellTopologyData<shards::Line<2>>()), degree);
  const int count = static_cast<int>(cubature.weights.extent(0));
  Values points("points", count, 2);
  for (int q = 0; q < count; ++q) {
    points(q, 0) = cubature.points(q, 0);
    points(q, 1) = -1.0;
  }
  const ReferenceElement whole = tabulate(square, points, cubature.weights);
  ReferenceElement side;
  side.nodes = nodes;
  side.points = count;
  side.dimension = 1;
  side.weights = whole.weights;
  const std::array<int, 3> onSide{0, 1, 4};
  for (int q = 0; q < count; ++q) {
    side.places.push_back(points(q, 0));
    for (int a = 0; a < nodes; ++a) {
      side.values.push_back(whole.valuesAt(q)[onSide[a]]);
      side.gradients.push_back(whole.gradientsAt(q)[2 * onSide[a]]);
    }
  }
  return side;
}

// A 3D side is a 2D cell. Squares are often curved or warped: uses more points, as above.
ReferenceElement makeFace(int nodes, Rule rule) {
  const Cell cell = sideCell(nodes);
  const int straight = isSimplex(cell) ? (nodes == 3 ? 2 : 6) : (nodes == 4 ? 5 : 7);
  return makeElement(cell, straight + (rule == Rule::Data ? 4 : 0));
}

constexpr int kRules = 7;
std::array<ReferenceElement, kCells * kRules> elementTables;  // without points: not created yet. Plain vectors: they outlive Kokkos
std::array<ReferenceElement, 2 * 2 * (kMostSideNodes + 1)> sideTables;

}  // namespace

const ReferenceElement& referenceElement(Cell cell, Rule rule) {
  ReferenceElement& table = elementTables[static_cast<int>(cell) * kRules + static_cast<int>(rule)];
  if (table.points == 0) table = makeElement(cell, degreeOf(cell, rule));
  return table;
}

bool isCurvedTetrahedron(const CellBlock& block, int element) {
  constexpr double kRounding = 1e-10;  // relative to an edge's length
  const Span<const int> nodes = block.nodesOf(element);
  const CellInfo& cell = cellInfo(Cell::Tetrahedron10);
  const double* x = block.coordinates.data();
  for (std::size_t i = 0; i < cell.edges.size(); ++i) {
    const double *a = x + 3 * std::size_t(nodes[cell.edges[i][0]]), *b = x + 3 * std::size_t(nodes[cell.edges[i][1]]),
                 *middle = x + 3 * std::size_t(nodes[cell.vertices + i]);
    double off = 0.0, length = 0.0;
    for (int k = 0; k < 3; ++k) {
      off += std::abs(2 * middle[k] - a[k] - b[k]);
      length += std::abs(b[k] - a[k]);
    }
    if (off > kRounding * length) return true;
  }
  return false;
}

const ReferenceElement& referenceSide(int nodes, int dimension, Rule rule) {
  if (nodes < 2 || nodes > kMostSideNodes) throw InternalError("a side of " + std::to_string(nodes) + " nodes");
  ReferenceElement& table = sideTables[(2 * nodes + (dimension == 3)) * 2 + (rule == Rule::Data)];
  if (table.points == 0) table = dimension == 2 ? makeSide(nodes, rule) : makeFace(nodes, rule);
  return table;
}

}  // namespace suture
