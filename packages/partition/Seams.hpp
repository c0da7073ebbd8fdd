#pragma once
#include <suture/partition/EntityGraph.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Seam entities that the subdomains of this rank touch, from the data of these subdomains alone, with memory proportional to their seams.
/// All ranks that touch an entity describe it identically, in the same order and direction, independent of their number. A node of two
/// subdomains lies only on the seam between them: either subdomain knows all its sides. Edges where further subdomains meet are given with
/// all of these (SubdomainMesh::seamEdges). In 2D nodes of more than two subdomains are vertices, regardless of their sides. Local.
/// \param subdomains  of this rank, as distribute() gives them
std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains);
std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains);

}  // namespace suture
