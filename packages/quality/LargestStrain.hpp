#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/answers/Extremes.hpp>

#include <vector>

namespace suture {

/// The largest strain and rotation of elements, at their centroids, by the linear theory, which assumes that both are small. Those below a
/// hundredth are not sought.
struct LargestStrain {
  Extreme strain;    ///< magnitude of a principal strain [-]
  Extreme rotation;  ///< rigid motions of a body included [rad]
};

/// Collective; the same on all ranks. \param displacement  of each mesh, beside its lift, node-major, Cartesian
LargestStrain largestStrain(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement);

}  // namespace suture
