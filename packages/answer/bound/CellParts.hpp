#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/mesh/SplitCell.hpp>

#include <vector>

namespace suture {

/// An element as simplices: a simplex itself, a quadrilateral as two triangles, a hexahedron as six tetrahedra, a wedge as three, a pyramid
/// as two.
template <int D>
struct CellParts {
  using Nodes = SimplexNodes<D>;
  struct Part {
    /// Places among the nodes of the cell, then the new ones, in the order of SimplexNodes; -1: the middle of an edge of a cell of order 1.
    std::array<int, Nodes::most> nodes;
    std::array<int, D + 1> sides;  ///< side of the cell that contains the side opposite to each vertex; -1: none
    double orientation = 1.0;      ///< sign of the determinant of the map to the vertices if the cell is convex
  };
  std::vector<Part> parts;
  std::vector<std::array<int, 2>> diagonals;  ///< vertices of the cell around each new node inside it
};

/// In 2D by the numbers of the nodes where diagonals are equal, so that it does not depend on the orientation. In 3D from the vertices that
/// come first along a fixed direction, so that opposite sides of a contact are cut alike. Local.
template <int D>
CellParts<D> cellParts(const CellBlock& block, int element);

/// Adds to the nodal forces of a quadrilateral's two triangles those of least norm with which their sums at the nodes are the forces of the
/// cell, and each triangle is in balance with its source. Local.
/// \param forces  at the nodes of the cell, then at the new one; they are in balance with the sources of both triangles [force]
/// \param order   of the cell: 1: forces at the vertices, 2: also at the middles of edges
/// \param simplices  one per part
void splitForces(const CellParts<2>& parts, const Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 10>& forces, int order,
                 BoundElement<2>* simplices);

/// The same in 3D, with the least change of the forces that the simplices have before. Local.
/// \param forces  at the nodes of the cell, then at the new ones; in balance with the sources of all simplices [force] \param places  of
/// the same nodes
void splitForces(const CellParts<3>& parts, const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& places, int order,
                 BoundElement<3>* simplices);

}  // namespace suture
