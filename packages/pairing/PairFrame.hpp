#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// The frame of a contact pair, or of any direction: the normal, then one tangent in the plane, the normal turned by a right angle
/// anticlockwise, or two in space, right-handed. Orthonormal. Local. \param normal  a unit vector
std::vector<Point> pairFrame(const Point& normal, int dimension);

}  // namespace suture
