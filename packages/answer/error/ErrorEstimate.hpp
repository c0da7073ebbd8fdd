#pragma once
#include <suture/answer/error/PatchRecovery.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Estimated discretisation error of a solution. Energy norms: sqrt(a(v, v)), [force x length]^(1/2).
struct DiscretisationError {
  double energyNorm = 0.0;         ///< energy norm of the error: eta
  double solutionNorm = 0.0;       ///< energy norm of the computed displacements
  std::vector<Vector> ofElements;  ///< eta_K of every element of every subdomain of this rank

  double relative() const { return solutionNorm > 0.0 ? energyNorm / solutionNorm : 0.0; }
};

/// Recovered stresses of each mesh (quality/PatchRecovery); patches across seams are summed over subdomains and ranks, so that the result
/// is independent of partition and ranks up to round-off. `displacement`: of each mesh, node-major, Cartesian. Meshes and model must
/// outlive the result. Collective.
std::vector<PatchRecovery> recoverStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                           const std::vector<Vector>& displacement);

/// Estimates the error from recovered stresses. Collective.
DiscretisationError estimateError(const Comm& comm, const std::vector<PatchRecovery>& recovered);
DiscretisationError estimateError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<Vector>& displacement);

}  // namespace suture
