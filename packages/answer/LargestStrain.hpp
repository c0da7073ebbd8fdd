#pragma once
#include <suture/answer/values/Extremes.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The largest strain and rotation of elements at their centroids, by linear theory, which assumes that both are small. Values below a
/// hundredth are ignored.
struct LargestStrain {
  Extreme strain;    ///< magnitude of a principal strain [-]
  Extreme rotation;  ///< including rigid motions of a body [rad]
};

/// Collective; the same on all ranks. \param displacement  of each mesh, without its lift, node-major, Cartesian
LargestStrain largestStrain(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement);

}  // namespace suture
