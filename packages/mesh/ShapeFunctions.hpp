#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

#include <array>

namespace suture {

/// A point of the reference cell: triangles are (0,0), (1,0), (0,1), quadrilaterals [-1,1]^2, tetrahedra have the vertices 0 and the unit
/// points, hexahedra are [-1,1]^3, wedges a triangle times [-1,1], pyramids have the base [-1,1]^2 and the apex (0,0,1). The third
/// component is zero in 2D.
using ReferencePoint = Point;

/// Reference point of a node. Local.
ReferencePoint referencePoint(Cell cell, int node);
/// Mean of the vertices' reference points. Local.
ReferencePoint referenceCentre(Cell cell);

/// Value and gradient, in reference coordinates, of the shape function that is one at its node and zero at the other nodes.
struct ShapeJet {
  double value = 0.0;
  ReferencePoint gradient{0, 0, 0};
};
/// Shape functions of all nodes of a cell at a point. At the apex of a pyramid, where gradients are undefined: their limit along the axis.
/// Local. \param jets  room for one entry per node
void shapeJets(Cell cell, const ReferencePoint& at, ShapeJet* jets);

/// Shape functions of the nodes of a 2D side (end points first, then the middle) on [-1, 1], and their derivatives. A 3D side is a cell:
/// sideCell(). Local. \throws InternalError  unless it has 2 or 3 nodes
struct SideShape {
  std::array<double, 3> value{}, slope{};
};
SideShape sideShape(int nodes, double xi);

}  // namespace suture
