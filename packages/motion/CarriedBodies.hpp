#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/motion/BodyParts.hpp>

#include <vector>

namespace suture {

/// True if a contact pair has a gap or an overlap above the round-off of the coordinates. Collective.
bool hasGaps(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

/// Rigid motions, in addition to `lift`, that bring bodies held only by contact to where they touch: the equilibrium of rigid bodies on
/// elastic pads (RigidBodyModel). Zero for a part that moves less than a thousand times the compression of its pads; the solver computes
/// such motions. Deformations are then not lost in the round-off of large displacements. Collective; the same on all ranks.
std::vector<Vector> carriedMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                   const BodyParts& parts);

}  // namespace suture
