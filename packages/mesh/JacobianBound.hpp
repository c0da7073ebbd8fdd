#pragma once
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

/// Determinant of the Jacobian of the map from the reference cell at one of its points. [area or volume] Local.
double jacobianAt(const CellBlock& block, int element, const ReferencePoint& at);

/// Its smallest value anywhere on the element, to 1e-3 of the largest; its sign is exact but for values within that of zero by a millionth.
/// The determinant is a polynomial: in Bernstein's form its values lie between the least and the largest coefficient, and coefficients at
/// the corners are values; halving brings the two together (Johnen, Remacle, Geuzaine, J. Comput. Phys. 2013). Simplices, wedges and
/// pyramids are the images of a square or a cube (Duffy), on which the determinant is a polynomial, too. Not a finite number where places
/// are too large for their products. Local. \param where  gets the place
double leastJacobian(const CellBlock& block, int element, ReferencePoint& where);

}  // namespace suture
