#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

#include <vector>

namespace suture {

// Geometry of a side from its nodes alone. In 2D a side has two or three nodes: end points first, with the body on the left of the
// direction from the first to the second. In 3D it has three or six (triangles), four, eight or nine nodes (quadrilaterals): vertices
// first, counter-clockwise seen from outside the body, then the mid-edge nodes, then the centre.

/// Shape of a 3D side. \throws InternalError  if no side has this number of nodes. Local.
Cell sideCell(int nodes);

/// Number of vertices of a side. \throws InternalError  if no side has this number of nodes. Local.
int sideVertices(int nodes, int dimension);

/// Outward normal at a node of a side.
struct NodeNormal {
  Point
      density;  ///< the integral of a function over the side is the integral of function x density over its reference cell [length or area]
  double weight;  ///< the node's share in the reference cell: the integral of its shape function, or where some of these are not positive
                  ///< (six- and eight-node sides) equal parts
};
/// The normals at a side's nodes. Nodal normals are averages of weight x density over the adjacent sides. Local.
std::vector<NodeNormal> nodeNormals(const std::vector<Point>& points, int dimension);

/// Adds to `sizes` the integrals over the side of its nodes' shape functions [length or area]. In 2D by the quadrature whose points are the
/// nodes (trapezoidal rule, Simpson's rule), exact for straight sides. Local.
/// \param axisymmetric  a side in the meridian plane represents the whole circle: factor 2 pi r, exact for straight sides [area]
void addTributarySizes(const std::vector<Point>& points, int dimension, bool axisymmetric, std::vector<double>& sizes);

/// Pairs of local nodes that are adjacent along a side's edges; the centre of nine nodes is adjacent to the mid-edge nodes. Local.
std::vector<std::pair<int, int>> sideSteps(int nodes, int dimension);

/// A side as linear cells between its nodes: segments, triangles and quadrilaterals, by local numbers, oriented like the side. Local.
std::vector<std::vector<int>> linearCells(int nodes, int dimension);

}  // namespace suture
