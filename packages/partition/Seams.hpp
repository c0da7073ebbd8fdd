#pragma once
#include <suture/partition/EntityGraph.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The entities of the seams that the subdomains of this rank touch, from these subdomains' own data alone, with memory in proportion to
/// their seams. All ranks that touch an entity describe it alike, in the same order and sense, whatever their number. In the plane a node
/// of two subdomains lies on no seam but the one between them, so that either knows all its sides; the sides of other nodes may be
/// incomplete, but these are vertices whatever their sides. Local. \param subdomains  of this rank, as distribute() gives them \throws
/// InternalError  in another dimension than two: edges in space need the sides of subdomains on other ranks.
std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains);
std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains);

}  // namespace suture
