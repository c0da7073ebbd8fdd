#pragma once
#include <suture/quality/ErrorEstimate.hpp>

#include <vector>

namespace suture {

/// Recovered stresses at the nodes: of each mesh nodes x as many as elementStresses() has, rows likewise. Where elements of several
/// materials of a body meet, each of which has a stress of its own, the mean over the elements. At nodes that subdomains share all of them
/// have the same value. Collective. \param recovered  of recoverStresses(), for the same meshes
std::vector<Matrix> nodalStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<PatchRecovery>& recovered);

}  // namespace suture
