// The only source that includes Intrepid2, for its quadrature rules.
#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Kokkos_Core.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>

namespace suture {
namespace {

using Device = Kokkos::Device<Kokkos::DefaultHostExecutionSpace, Kokkos::HostSpace>;
using Values = Kokkos::DynRankView<double, Device>;

template <typename Topology>
shards::CellTopology topologyOf() {
  return shards::CellTopology(shards::getCellTopologyData<Topology>());
}

shards::CellTopology topologyOf(Cell cell) {
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
      return topologyOf<shards::Triangle<3>>();
    case Cell::Quadrilateral4:
    case Cell::Quadrilateral8:
    case Cell::Quadrilateral9:
      return topologyOf<shards::Quadrilateral<4>>();
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return topologyOf<shards::Tetrahedron<4>>();
    case Cell::Hexahedron8:
    case Cell::Hexahedron20:
    case Cell::Hexahedron27:
      return topologyOf<shards::Hexahedron<8>>();
    case Cell::Wedge6:
      return topologyOf<shards::Wedge<6>>();
    case Cell::Pyramid5:
      return topologyOf<shards::Pyramid<5>>();
  }
  throw InternalError("no quadrature for a cell of kind " + std::to_string(static_cast<int>(cell)));
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

/// A table with the points and weights of a rule, without shape functions.
ReferenceElement quadrature(const shards::CellTopology& topology, int degree, int nodes) {
  if (!Kokkos::is_initialized())
    throw InternalError("Kokkos is not initialised: programs that use elements need a Tpetra::ScopeGuard in main()");
  const auto cubature = Intrepid2::DefaultCubatureFactory::create<Device, double, double>(topology, degree);
  ReferenceElement table;
  table.nodes = nodes;
  table.points = cubature->getNumPoints();
  table.dimension = cubature->getDimension();
  Values points("points", table.points, table.dimension), weights("weights", table.points);
  cubature->getCubature(points, weights);
  for (int q = 0; q < table.points; ++q) {
    table.weights.push_back(weights(q));
    for (int k = 0; k < table.dimension; ++k) table.places.push_back(points(q, k));
  }
  return table;
}

ReferenceElement makeElement(Cell cell, int degree) {
  ReferenceElement table = quadrature(topologyOf(cell), degree, cellInfo(cell).nodes);
  ShapeJet jets[kMostCellNodes];
  for (int q = 0; q < table.points; ++q) {
    ReferencePoint at{0, 0, 0};
    std::copy_n(table.placeAt(q), table.dimension, at.begin());
    shapeJets(cell, at, jets);
    for (int a = 0; a < table.nodes; ++a) {
      table.values.push_back(jets[a].value);
      for (int k = 0; k < table.dimension; ++k) table.gradients.push_back(jets[a].gradient[k]);
    }
  }
  return table;
}

ReferenceElement makeSide(int nodes, Rule rule) {
  // A constant traction on a curved side has the square root of a polynomial in its integrand: uses two points more than a straight side.
  const int degree = (nodes == 2 ? 3 : 7) + (rule == Rule::Data ? 4 : 0);
  ReferenceElement table = quadrature(topologyOf<shards::Line<2>>(), degree, nodes);
  for (int q = 0; q < table.points; ++q) {
    const SideShape shape = sideShape(nodes, table.places[q]);
    table.values.insert(table.values.end(), shape.value.begin(), shape.value.begin() + nodes);
    table.gradients.insert(table.gradients.end(), shape.slope.begin(), shape.slope.begin() + nodes);
  }
  return table;
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
