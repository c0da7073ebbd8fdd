#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture {

/// A place in the reference cell: triangles are (0,0), (1,0), (0,1), quadrilaterals [-1,1]^2, tetrahedra have the vertices 0 and the unit
/// points, hexahedra are [-1,1]^3, wedges a triangle times [-1,1], pyramids have the base [-1,1]^2 and the apex (0,0,1). The third
/// component is zero in the plane.
using ReferencePoint = Point;

/// Place of a node. Local.
ReferencePoint referencePoint(Cell cell, int node);
/// Mean of the vertices' places. Local.
ReferencePoint referenceCentre(Cell cell);
/// Value at a place of the shape function that is one at `node` and zero at the others. Local.
double shapeFunction(Cell cell, int node, const ReferencePoint& at);
/// Its gradient in reference coordinates; at the apex of a pyramid, where it has none, its limit along the axis. Local.
ReferencePoint shapeGradient(Cell cell, int node, const ReferencePoint& at);

/// Value and gradient of a shape function.
struct ShapeJet {
  double value = 0.0;
  ReferencePoint gradient{0, 0, 0};
};
/// Those of all nodes of a cell at a place, for less than one by one. \param jets  gets as many as the cell has nodes. Local.
void shapeJets(Cell cell, const ReferencePoint& at, ShapeJet* jets);

}  // namespace suture
