#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <unordered_map>
#include <vector>

namespace suture {

/// Subdomain -> rank that holds it, for all subdomains. Collective. \param meshes  subdomains of this rank
std::unordered_map<int, int> ranksOfSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

}  // namespace suture
