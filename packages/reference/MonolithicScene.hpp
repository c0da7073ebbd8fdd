#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/reference/MonolithicSystem.hpp>
#include <suture/solver/Solution.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The matrix and the loads of the reference, on rank 0; null on the others. Collective.
std::shared_ptr<const MonolithicSystem> assembleMonolithic(const Comm& comm, const Mesh& mesh, const Constraints& constraints,
                                                           const ElasticModel& model);

/// The reference: rank 0 solves the whole system, all ranks get their part of the answer. Collective. \throws NumericalError, InputError
/// \param system  of assembleMonolithic()
Solution solveMonolithicScene(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const MonolithicSystem* system,
                              const std::vector<SubdomainMesh>& meshes, const Parameters& scene, Monitor& monitor);

}  // namespace suture
