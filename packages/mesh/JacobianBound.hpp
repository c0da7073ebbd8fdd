#pragma once
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

/// Determinant of the Jacobian of the map from the reference cell at a reference point. [area or volume] Local.
double jacobianAt(const CellBlock& block, int element, const ReferencePoint& at);

/// Smallest Jacobian determinant anywhere on the element, to 1e-3 of the largest; its sign is exact except for values within a millionth of
/// that tolerance around zero. The determinant is a polynomial: in Bernstein form its values lie between the smallest and the largest
/// coefficient, and the coefficients at the corners are values; subdivision tightens these bounds (Johnen, Remacle, Geuzaine, J. Comput.
/// Phys. 2013). Simplices, wedges and pyramids are images of a square or a cube (Duffy), on which the determinant is a polynomial, too. Not
/// finite if products of the coordinates overflow. Local. \param where  gets the reference point
double leastJacobian(const CellBlock& block, int element, ReferencePoint& where);

}  // namespace suture
