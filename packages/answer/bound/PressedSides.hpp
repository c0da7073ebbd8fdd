#pragma once
#include <suture/base/Types.hpp>

#include <limits>
#include <vector>

namespace suture {

/// The sides of one contact on one body (side A): flat simplices, segments in 2D and triangles in 3D, with Lagrange nodes of degree 1 or 2.
/// The nodes of a side are its vertices, then the mid-edge nodes; in 3D those of the edges (0,1), (1,2), (0,2) of its vertices.
struct PressedSides {
  int dimension = 2;
  int degree = 1;
  std::vector<int> nodes;                                  ///< sides x sideNodes(): numbers of contact nodes, from 0
  std::vector<double> sizes;                               ///< length or area of each side [length or length^2]
  std::vector<Point> places;                               ///< contact nodes [length]
  std::vector<double> forces;                              ///< normal contact force of each node, positive in compression [force]
  double limit = std::numeric_limits<double>::infinity();  ///< largest pressure [stress]
  bool mayPull = false;                                    ///< true: pressures of any sign, for sides that do not separate; no limit

  int vertices() const { return dimension; }
  int sideNodes() const { return degree == 1 ? dimension : dimension * (dimension + 1) / 2; }
  int sides() const { return static_cast<int>(sizes.size()); }
  int count() const { return static_cast<int>(places.size()); }  ///< number of contact nodes
  const int* nodesOf(int side) const { return nodes.data() + static_cast<std::ptrdiff_t>(side) * sideNodes(); }
};

/// Local numbers of the two vertices of the mid-edge node `edge` (0 .. dimension) of a side of degree 2.
std::array<int, 2> edgeVertices(int edge);

/// Integrals of phi_i phi_j over a side of size 1; phi are its Lagrange functions. sideNodes x sideNodes. Local.
const Matrix& sideMass(int dimension, int degree);

/// Nodal values of the Bernstein polynomials of a side. sideNodes x sideNodes, one column per polynomial; polynomials are numbered like
/// nodes. A combination with nonnegative coefficients is nonnegative on the whole side. Local.
const Matrix& bernsteinValues(int dimension, int degree);

/// \throws InternalError  if lengths of arrays, numbers of nodes, sizes of sides or values are invalid. Local.
void check(const PressedSides& sides);

}  // namespace suture
