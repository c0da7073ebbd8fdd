#pragma once
#include <suture/answer/solvability/PrescribedMeans.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/motion/RigidMotion.hpp>

namespace suture {

/// Checks before any solve, from geometry and loads alone, that the scene has exactly one solution. Notation: z is a rigid motion of all
/// parts that the prescribed components allow, B z = (u_A - u_B).n are its contact rows, w.z is the work of the loads. Local (rank 0).
///
/// - A part with neither prescribed components nor contact is not held.
/// - A solution exists if and only if no z with B z <= 0 does positive work: equivalently (Farkas) if contact forces p >= 0 with B^T p = w
///   exist. This is a nonnegative least squares problem for p; its residual is the motion by which a body escapes.
/// - Friction laws add forces: edges of their cones; tangential forces of any size if a bound without pressure exists (cohesion, Tresca:
///   the solver finds out whether it suffices); both signs if sides are tied or never separate.
/// - A prescribed mean displacement adds a force of any size and either sign, with the weights of the mean; a motion that changes the mean
///   is not free.
/// - The solution is unique only if B z = 0 has no solution other than z = 0. A body with such a motion slides along its contacts: its
///   position is not determined. B z counts as zero up to the accuracy of mesh files: a round body turns in its round seat.
/// - A motion with nonzero B z <= 0 that does no work (grazing contact; a body that rests on its seat without load) is allowed: solvers
///   start with closed contact and keep it.
/// - A pair with all components prescribed must not be prescribed into penetration.
///
/// Amplitudes of motions are lengths, and works are compared with the loads and contact forces of the same body, so the check does not
/// depend on units.
///
/// \param forces  nodal forces of the loads (nodalLoads): node-major, Cartesian
/// \param means   mean displacements that count as supports
/// \throws InputError  names each free body and its motion
void checkSolvability(const Mesh& mesh, const Constraints& constraints, const Vector& forces, const RigidParts& rigid,
                      const std::vector<PrescribedMean>& means = {});

/// The same, with loads, means and free motions computed from the model. \param model  with resolved loads \param bodiesAreConnected  as
/// for freeRigidMotions()
void checkSolvability(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, bool bodiesAreConnected = false);

}  // namespace suture
