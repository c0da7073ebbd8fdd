#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/motion/BodyParts.hpp>

#include <functional>
#include <vector>

namespace suture {

/// True if a scene prescribes a nonzero displacement. Collective.
bool prescribesMotion(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

/// Returns amplitudes of each part relative to its lift, or nothing.
using CarriedMotions = std::function<std::vector<Vector>(const BodyParts& parts)>;

/// Removes large rigid-body motions from a scene before it is solved, because otherwise strains are differences of large numbers: each
/// connected part of a body whose prescribed displacements are (nearly) those of a rigid-body motion is described relative to that motion.
/// Prescribed values and gaps become the remainders; SubdomainMesh::lift stores the motion and the original values.
///
/// Parts that prescribed displacements leave free may be moved, too: `carry` gets all parts and returns amplitudes relative to their
/// `lift`, the same on all ranks.
///
/// The motion is evaluated in extended precision: equal prescribed translations leave exactly equal remainders. A scene with only zero
/// prescribed values is unchanged, to the last bit. Collective. Returns true if a motion was removed.
/// \param meshes  of this rank; call only once per scene
bool takeOutRigidMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const CarriedMotions& carry = {});

/// Moves the parts of a scene further, after their rigid-body motions have been removed: updates gaps, and rules, which such a motion
/// should not change. Collective.
/// \param motion  amplitudes of each part as BodyParts has them, the same on all ranks
void moveFurther(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& motion);

/// Copies the remaining rules and gaps of the subdomains into rank 0's constraints of the whole mesh. Collective.
void adopt(const Comm& comm, const std::vector<SubdomainMesh>& meshes, Constraints& constraints);

/// Displacements of a mesh's nodes including the removed motion, and relative to it. Node-major, Cartesian [length]. Local.
Vector withLift(const SubdomainMesh& mesh, Vector beside);
Vector besideLift(const SubdomainMesh& mesh, Vector displacement);

}  // namespace suture
