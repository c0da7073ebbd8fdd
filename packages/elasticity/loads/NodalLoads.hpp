#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <functional>

namespace suture {

/// Nodal forces of all loads, including initial strains and stresses: nodes x dimension, node-major, Cartesian [force]. Local.
Vector nodalLoads(const Mesh& mesh, const ElasticModel& model);

/// The same on a subdomain, such that the sum over all subdomains equals the whole mesh: forces on shared nodes belong to the lowest
/// subdomain. Local.
Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model);

/// Forces of the loads on a subdomain without initial strains and stresses, load by load: calls take(number, forces) for every load of the
/// model that acts there. The forces are valid during the call only. Local.
void forEachLoad(const SubdomainMesh& mesh, const ElasticModel& model, const std::function<void(int number, const Vector& forces)>& take);

/// Forces of initial strains and stresses only; empty if there are none. \param sizes  as for initialForces() of a block. Local.
Vector initialForces(const Mesh& mesh, const ElasticModel& model, Vector* sizes = nullptr);
Vector initialForces(const SubdomainMesh& mesh, const ElasticModel& model, Vector* sizes = nullptr);

}  // namespace suture
