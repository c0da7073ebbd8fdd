#pragma once
#include <suture/partition/cut/MeshShare.hpp>

#include <vector>

namespace suture {

/// Cost of a subdomain from assembly to solution with explicit Schur complements, in nodes: what is done with all of its b interface
/// nodes at once grows with b^2 or b^3 and is as much as the rest for usual sizes. b^2 / 16 fits the times of the 268 subdomains of tunnel
/// and Hertz at 1M unknowns (3600 nodes, 120 to 340 on the interface; single times scatter by 15 %, whole halves of a scene differ by a
/// tenth).
constexpr long long expectedCost(long long nodes, long long interfaceNodes) { return nodes + interfaceNodes * interfaceNodes / 16; }

/// Costs of every subdomain, on rank 0. Interface nodes are those that several subdomains hold, and those in contact. Collective.
/// \param subdomains      their number, on rank 0
/// \param contactHolders  holders of the nodes in contact, on rank 0
std::vector<long long> expectedCosts(const Comm& comm, const CellBlock& mesh, const MeshShare& share, int subdomains,
                                     const NodeSubdomains& contactHolders);

}  // namespace suture
