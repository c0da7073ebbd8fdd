#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/BodyParts.hpp>

#include <vector>

namespace suture {

/// True if a contact pair has a gap or an overlap that is more than rounding of the coordinates. Collective.
bool hasGaps(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

/// Amplitudes that carry bodies which only contact will hold to where they touch: the equilibrium of rigid bodies on elastic pads
/// (RigidContact), beside the motions `lift` of the parts. Zero for a part that moves less than a thousand times the compression of its
/// pads. Solvers do the rest; but from here on no deformation hides in the rounding of a journey. Collective; the same on all ranks.
std::vector<Vector> carriedMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                   const BodyParts& parts);

}  // namespace suture
