#pragma once
#include <suture/mesh/Surface.hpp>

#include <vector>

namespace suture {

/// Division of a surface of straight sides in space into the faces of the geometry that its nodes lie on.
struct SmoothParts {
  std::vector<int> partOf;   ///< number of its part, by side
  std::vector<char> isFlat;  ///< true of sides of plane parts
};

/// Divides a surface where faces of the geometry end: between sides of different groups; around regions of coplanar sides that go on, or
/// have a node with all sides around it, so that rows of sides along a cylinder are none; and at edges of more than five degrees and three
/// times all others nearby. Local. \param groupOf  by side; empty: one for all
SmoothParts smoothParts(const Surface& surface, const std::vector<int>& groupOf);

}  // namespace suture
