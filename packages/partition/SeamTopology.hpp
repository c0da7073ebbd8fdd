#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

enum class EntityClass : int { Corner = 0, Edge = 1, Face = 2 };

/// A maximal connected set of seam nodes that the same subdomains share: a corner is a single node (a cross point, or an end point of an
/// edge where a seam meets the boundary), an edge what lies between corners. Connected means through element sides that lie on the seam,
/// that is, that are sides of two subdomains.
struct SeamEntity {
  EntityClass kind = EntityClass::Edge;
  std::vector<int> subdomains;      ///< ascending
  std::vector<GlobalId> nodes;      ///< of an edge: in order along it, end points (corners) not included
  std::vector<GlobalId> endPoints;  ///< of an edge: its two end points (one, twice, or none for a closed ring)
};

/// The entities that the subdomains of this rank touch: corners by node, then edges by subdomains and first node. A stretch of seam between
/// two corners without a node of its own is not listed. In two dimensions: corners are nodes of three or more subdomains, nodes where
/// a seam ends, touches itself, or has no side at all (subdomains that meet in that point only). All ranks that touch an entity describe it
/// alike, in the same order and sense, whatever their number. From the subdomains' own data alone, with memory in proportion to their
/// seams. Local.
/// \param subdomains  of this rank, as distribute() gives them
/// \throws InternalError  in another dimension than two.
std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains);
std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains);

}  // namespace suture
