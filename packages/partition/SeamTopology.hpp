#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

enum class EntityClass : int { Corner = 0, Edge = 1, Face = 2 };

/// A maximal connected set of seam nodes that the same subdomains share: a corner is a single node (a cross point, or an end point of an
/// edge where a seam meets the boundary), an edge what lies between corners.
struct SeamEntity {
  EntityClass kind = EntityClass::Edge;
  std::vector<int> subdomains;      ///< ascending
  std::vector<GlobalId> nodes;      ///< of an edge: in order along it, end points (corners) not included
  std::vector<GlobalId> endPoints;  ///< of an edge: its two end points (one, twice, or none for a closed ring)
};

}  // namespace suture
