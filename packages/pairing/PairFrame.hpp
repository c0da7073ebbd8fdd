#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairing/ContactPair.hpp>

#include <vector>

namespace suture {

/// The frame of a contact pair, or of any direction: the normal, then one tangent in the plane, the normal turned by a right angle
/// anticlockwise, or two in space, right-handed. Orthonormal. Local. \param normal  a unit vector
std::vector<Point> pairFrame(const Point& normal, int dimension);

/// The frame of a pair. In space one in which nothing slides along some tangent has that as its last, and the other beside it.
std::vector<Point> pairFrame(const ContactPair& pair, int dimension);

}  // namespace suture
