#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/BodyParts.hpp>

#include <functional>
#include <vector>

namespace suture {

/// True if a scene prescribes a displacement that is not zero. Collective.
bool prescribesMotion(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

/// Amplitudes of each part beside its lift, or nothing.
using CarriedMotions = std::function<std::vector<Vector>(const BodyParts& parts)>;

/// Takes large rigid motions out of a scene before it is solved, so that strains are no differences of large numbers: each connected part
/// of a body whose prescribed displacements are those of a rigid motion, or nearly so, is described from where that motion takes it.
/// Prescribed values and gaps are what remains of them; SubdomainMesh::lift keeps the motion and what stood there before.
///
/// Parts that prescribed displacements leave free may be carried, too: `carry` gets all parts and returns amplitudes beside their `lift`,
/// the same on all ranks.
///
/// The motion is evaluated in extended precision, so that equal prescribed translations leave exactly equal remainders. A scene that
/// prescribes nothing but zeros stays as it is, to the last bit. Collective. Returns true if there was anything to take out.
/// \param meshes  of this rank; those of one scene only once
bool takeOutRigidMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const CarriedMotions& carry = {});

/// Moves the parts of a scene further, whose rigid motions are out of it already: gaps follow, and rules, which such a motion should leave
/// alone. Collective.
/// \param motion  amplitudes of each part as BodyParts has them, the same on all ranks
void moveFurther(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& motion);

/// The same rules and gaps for the whole mesh: rank 0's constraints get what remains in the subdomains. Collective.
void takeOver(const Comm& comm, const std::vector<SubdomainMesh>& meshes, Constraints& constraints);

/// Displacements of a mesh's nodes, the motion that was taken out included, and beside it. Node-major, Cartesian [length]. Local.
Vector withLift(const SubdomainMesh& mesh, Vector beside);
Vector besideLift(const SubdomainMesh& mesh, Vector displacement);

}  // namespace suture
