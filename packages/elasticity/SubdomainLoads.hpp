#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {

/// Nodal forces of all loads on a subdomain (nodes x dimension, node-major, Cartesian), so that the sum over all subdomains is that of the
/// whole mesh: forces on nodes belong to the lowest subdomain there. Local.
Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model);

}  // namespace suture
