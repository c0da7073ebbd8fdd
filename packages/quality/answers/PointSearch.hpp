#pragma once
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// A point and where it is sought.
struct SoughtPoint {
  Point place{0, 0, 0};
  int body = -1;  ///< -1: in any
};

/// A point in an element of a mesh of this rank.
struct PointInElement {
  int mesh = -1;  ///< place among the meshes of this rank; -1: another rank has it, or nobody
  int element = -1;
  ReferencePoint at{0, 0, 0};
};

/// Where points lie: each in one element of one rank.
struct FoundPoints {
  std::vector<PointInElement> here;  ///< by point
  /// Points outside all bodies that count: their numbers, ascending, and "'left' is nearest, 0.25 away at (1, 2)". The same on all
  /// ranks.
  std::vector<int> outside;
  std::vector<std::string> nearest;
};

/// Finds the elements that hold points of the undeformed bodies. A point that is outside by less than a twentieth of an element counts as
/// in it: a side of straight elements cuts the curve that it stands for. Where several elements have it the lowest body, then element, so
/// that a point on a contact line or surface is in the first body unless its body is given. Collective.
FoundPoints findPoints(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                       const std::vector<SoughtPoint>& points);

}  // namespace suture
