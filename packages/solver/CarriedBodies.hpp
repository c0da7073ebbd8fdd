#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/BodyParts.hpp>

#include <vector>

namespace suture {

/// True if a gap is so large, in sizes of the bodies, that a body may have far to go. Collective.
bool hasFarGaps(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

/// Amplitudes that carry bodies which only contact will hold, and which are far from it, to where they touch: the equilibrium of rigid
/// bodies on elastic pads (RigidContact), beside the motions `lift` of the parts. Zero for a part that has less than ten of its sizes to
/// go. Solvers do the rest; but from here on no displacement hides in the rounding of a journey. Collective; the same on all ranks.
std::vector<Vector> carriedMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                   const BodyParts& parts);

}  // namespace suture
