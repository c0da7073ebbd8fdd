#pragma once
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// A point to be located.
struct SoughtPoint {
  Point place{0, 0, 0};
  int body = -1;  ///< -1: any body
};

/// A point in an element of a mesh of this rank.
struct PointInElement {
  int mesh = -1;  ///< index among the meshes of this rank; -1: on another rank or not found
  int element = -1;
  ReferencePoint at{0, 0, 0};
};

/// Locations of points: each in one element on one rank.
struct FoundPoints {
  std::vector<PointInElement> here;  ///< by point
  /// Points outside all bodies in question: their numbers, ascending, and "'left' is nearest, 0.25 away at (1, 2)". The same on all ranks.
  std::vector<int> outside;
  std::vector<std::string> nearest;
};

/// Finds the elements that contain points of the undeformed bodies. A point that is outside by less than a twentieth of an element counts
/// as inside, because straight sides cut off curves. If several elements contain it, the lowest body, then the lowest element is chosen: a
/// point on a contact line or surface is in the first body unless its body is given. Collective.
FoundPoints findPoints(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                       const std::vector<SoughtPoint>& points);

}  // namespace suture
