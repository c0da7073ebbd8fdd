#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

#include <vector>

namespace suture {

// Geometry of a side from its nodes alone. In the plane a side has two or three nodes: end points first, the body on the left of the way
// from the first to the second. In space it has three or six (triangles), four, eight or nine nodes (quadrilaterals): vertices first,
// counter-clockwise seen from outside the body, then the middles of the edges, then the centre.

/// Shape of a side in space. \throws InternalError  there is no side of so many nodes. Local.
Cell sideCell(int nodes);

/// Number of vertices of a side. \throws InternalError  there is no side of so many nodes. Local.
int sideVertices(int nodes, int dimension);

/// Outward normal at a node of a side.
struct NodeNormal {
  Point density;  ///< the integral of a function over the side is that of function x density over its reference cell [length or area]
  double weight;  ///< the node's share in the reference cell: the integral of its shape function, or where some of these are not positive
                  ///< (six- and eight-node sides) equal parts
};
/// The normals at a side's nodes. Nodal normals are means over sides of weight x density. Local.
std::vector<NodeNormal> nodeNormals(const std::vector<Point>& points, int dimension);

/// Adds to `sizes` the integrals over the side of its nodes' shape functions [length or area]. In the plane by the quadrature whose points
/// are the nodes (trapezoidal rule, Simpson's), exact for straight sides. Local.
/// \param axisymmetric  a side in the meridian plane stands for the whole circle: times 2 pi r, exact for straight sides [area]
void addTributarySizes(const std::vector<Point>& points, int dimension, bool axisymmetric, std::vector<double>& sizes);

/// Local numbers of nodes that follow each other along a side's edges; the centre of nine nodes follows the middles of edges. Local.
std::vector<std::pair<int, int>> sideSteps(int nodes, int dimension);

/// A side as linear cells between its nodes: segments, triangles and quadrilaterals, by local numbers, oriented as the side. Local.
std::vector<std::vector<int>> linearCells(int nodes, int dimension);

}  // namespace suture
