#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/RigidMotion.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Has the scene a solution, and one only? Decided before any solve from geometry and loads alone: z a rigid motion of all parts that the
/// prescribed components allow, B z its contact rows (u_A - u_B).n, w.z the work of the loads. Local (rank 0).
///
/// - A part with neither prescribed components nor contact is held by nothing.
/// - A solution exists if and only if no z with B z <= 0 does positive work: equivalently (Farkas) if contact forces p >= 0 with B^T p = w
///   exist. The nonnegative least squares problem for p tells; its residual is the motion by which a body escapes.
/// - Laws of friction add forces: edges of their cones, tangential forces of any size where a bound without pressure exists (cohesion,
///   Tresca: the solver finds out whether it is enough), both senses where sides are glued or never part.
/// - The solution is unique only if no z other than zero has B z = 0. Such a body keeps its contacts and slides: its place is not
///   determined. B z counts as zero up to the accuracy of mesh files: a round body turns in its round seat.
/// - A motion with B z <= 0, not zero, that does no work (grazing contact; a body that rests on its seat without load) is legitimate:
/// solvers
///   start with closed contact and keep it.
/// - A pair whose components are all prescribed must not be prescribed into penetration.
///
/// Amplitudes of motions are lengths and works are compared with the loads and contact forces of the same body: independent of units.
///
/// \param forces  nodal forces of the loads (nodalLoads): node-major, Cartesian
/// \throws InputError  names every body and the motion that it is free to make
void checkSolvability(const Mesh& mesh, const Constraints& constraints, const Vector& forces, const RigidParts& rigid);

/// The same from the beginning. \param bodiesAreConnected  as for freeRigidMotions()
void checkSolvability(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, bool bodiesAreConnected = false);

}  // namespace suture
