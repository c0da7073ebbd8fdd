#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <functional>

namespace suture {

/// Nodal forces of all loads, those of initial strains and stresses among them: nodes x dimension, node-major, Cartesian [force]. Local.
Vector nodalLoads(const Mesh& mesh, const ElasticModel& model);

/// The same on a subdomain, so that the sum over all subdomains is that of the whole mesh: forces on nodes belong to the lowest subdomain
/// there. Local.
Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model);

/// Those of the loads on a subdomain without initial strains and stresses, load by load: calls take(number, forces) for every load of the
/// model that acts there. The forces are valid during the call only. Local.
void forEachLoad(const SubdomainMesh& mesh, const ElasticModel& model, const std::function<void(int number, const Vector& forces)>& take);

/// Those of initial strains and stresses alone; empty where there are none. \param sizes  as for initialForces() of a block. Local.
Vector initialForces(const Mesh& mesh, const ElasticModel& model, Vector* sizes = nullptr);
Vector initialForces(const SubdomainMesh& mesh, const ElasticModel& model, Vector* sizes = nullptr);

}  // namespace suture
