#pragma once
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/answer/bound/CellParts.hpp>

namespace suture {

/// Distance of a mid-side node from the middle, relative to the size, that is round-off.
constexpr double kStraightSide = 1e-9;
constexpr const char* kCurvedSides = "elements have curved sides";

/// A quadrilateral as two triangles with its stresses and nodal forces. Local.
SplitElement<2> splitQuadrilateral(BoundedField<2>& field, int element, const CellParts<2>& parts, double& oscillation);

/// Forces at the nodes of a quadrilateral, and at the middle of its diagonal.
using QuadrilateralForces = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 10>;
/// A force at the centre of a cell acts at the middle of the diagonal there. Local.
QuadrilateralForces withNewNode(Cell cell, const CellParts<2>& parts, const QuadrilateralForces& forces);

}  // namespace suture
