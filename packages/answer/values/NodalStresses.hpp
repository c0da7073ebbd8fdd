#pragma once
#include <suture/answer/error/ErrorEstimate.hpp>

#include <vector>

namespace suture {

/// Recovered stresses at the nodes: for each mesh a matrix of nodes x components, as in elementStresses(). Where elements of several
/// materials of a body meet and have different stresses, the mean over the elements. Subdomains have equal values at shared nodes.
/// Collective. \param recovered  of recoverStresses(), for the same meshes
std::vector<Matrix> nodalStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<PatchRecovery>& recovered);

}  // namespace suture
