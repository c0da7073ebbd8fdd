#pragma once
#include <suture/partition/cut/MeshShare.hpp>

#include <vector>

namespace suture {

/// Costs of every subdomain (CostModel::work), on rank 0. Interface nodes are those that several subdomains hold, and those in contact.
/// Collective. \param subdomains      number of subdomains, on rank 0 \param contactHolders  holders of the nodes in contact, on rank 0
std::vector<long long> expectedCosts(const Comm& comm, const CellBlock& mesh, const MeshShare& share, int subdomains,
                                     const NodeSubdomains& contactHolders);

}  // namespace suture
