#pragma once
#include <suture/mesh/Surface.hpp>

#include <vector>

namespace suture {

/// Division of a 3D surface of straight sides into the faces of the geometry on which its nodes lie.
struct SmoothParts {
  std::vector<int> partOf;   ///< number of the part of each side
  std::vector<char> isFlat;  ///< true for sides of plane parts
};

/// Divides a surface where faces of the geometry end: between sides of different groups; around regions of coplanar sides that continue
/// around a node or contain a node with all of its sides, so that rows of sides along a cylinder do not count; and at edges whose angle
/// exceeds five degrees and three times all others nearby. Local. \param groupOf  by side; empty: a single group
SmoothParts smoothParts(const Surface& surface, const std::vector<int>& groupOf);

}  // namespace suture
