#pragma once
#include <suture/answer/values/Extremes.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The largest strain and rotation of elements at their centroids, by linear theory, which assumes that both are small.
struct LargestStrain {
  Extreme strain;    ///< magnitude of a principal strain [-]
  Extreme rotation;  ///< including rigid motions of a body [rad]
};

/// Collective; the same on all ranks. \param displacement  of each mesh, without its lift, node-major, Cartesian
/// \param least  smaller values are ignored \param body  of this body; -1: of all
LargestStrain largestStrain(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                            double least = 0.01, int body = -1);

}  // namespace suture
