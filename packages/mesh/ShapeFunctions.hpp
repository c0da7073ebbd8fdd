#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture {

/// A point of the reference cell: triangles are (0,0), (1,0), (0,1), quadrilaterals [-1,1]^2, tetrahedra have the vertices 0 and the unit
/// points, hexahedra are [-1,1]^3, wedges a triangle times [-1,1], pyramids have the base [-1,1]^2 and the apex (0,0,1). The third
/// component is zero in 2D.
using ReferencePoint = Point;

/// Reference point of a node. Local.
ReferencePoint referencePoint(Cell cell, int node);
/// Mean of the vertices' reference points. Local.
ReferencePoint referenceCentre(Cell cell);
/// Value of the shape function that is one at `node` and zero at the other nodes. Local.
double shapeFunction(Cell cell, int node, const ReferencePoint& at);
/// Gradient of the shape function in reference coordinates; at the apex of a pyramid, where it is undefined, its limit along the axis.
/// Local.
ReferencePoint shapeGradient(Cell cell, int node, const ReferencePoint& at);

/// Value and gradient of a shape function.
struct ShapeJet {
  double value = 0.0;
  ReferencePoint gradient{0, 0, 0};
};
/// Shape functions of all nodes of a cell at one point, cheaper than one by one. \param jets  room for one entry per node. Local.
void shapeJets(Cell cell, const ReferencePoint& at, ShapeJet* jets);

}  // namespace suture
