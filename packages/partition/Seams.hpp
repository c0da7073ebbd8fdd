#pragma once
#include <suture/partition/EntityGraph.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The entities of the seams that the subdomains of this rank touch, from these subdomains' own data alone, with memory in proportion to
/// their seams. All ranks that touch an entity describe it alike, in the same order and sense, whatever their number. A node of two
/// subdomains lies on no seam but the one between them, so that either knows all its sides; edges where others meet, too, come with all
/// that meet there (SubdomainMesh::seamEdges). In the plane other nodes are vertices whatever their sides. Local.
/// \param subdomains  of this rank, as distribute() gives them
std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains);
std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains);

}  // namespace suture
