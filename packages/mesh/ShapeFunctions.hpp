#pragma once
#include <suture/mesh/Cell.hpp>

#include <array>

namespace suture {

/// A place in the reference cell: triangles are (0,0), (1,0), (0,1), quadrilaterals [-1,1]^2.
using ReferencePoint = std::array<double, 2>;

/// Place of a node. Local.
ReferencePoint referencePoint(Cell cell, int node);
/// Value at a place of the shape function that is one at `node` and zero at the others. Local.
double shapeFunction(Cell cell, int node, ReferencePoint at);
/// Its gradient in reference coordinates. Local.
ReferencePoint shapeGradient(Cell cell, int node, ReferencePoint at);

}  // namespace suture
