#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <functional>

namespace suture {

/// Nodal forces of all loads on a subdomain (nodes x dimension, node-major, Cartesian), so that the sum over all subdomains is that of the
/// whole mesh: forces on nodes belong to the lowest subdomain there. Local.
Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model);

/// The same load by load: calls take(number, forces) for every load of the model that acts on the subdomain. The forces are valid during
/// the call only. Local.
void forEachLoad(const SubdomainMesh& mesh, const ElasticModel& model, const std::function<void(int number, const Vector& forces)>& take);

}  // namespace suture
