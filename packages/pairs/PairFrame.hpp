#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <vector>

namespace suture {

/// Orthonormal frame of a contact pair or of any direction: the normal, followed in 2D by one tangent, the normal rotated anticlockwise by
/// a right angle, and in 3D by two tangents, right-handed. Local. \param normal  a unit vector
std::vector<Point> pairFrame(const Point& normal, int dimension);

/// Frame of a pair. In 3D, if sliding is blocked along a tangent, that tangent is the last vector.
std::vector<Point> pairFrame(const ContactPair& pair, int dimension);

}  // namespace suture
