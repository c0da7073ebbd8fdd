#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Removes prescribed rigid motions from the scene (takeOutRigidMotions()); call it after the checks and before assembly. `constraints` of
/// rank 0, for methods that need the whole mesh, are updated accordingly; they may be empty. Returns the work of the loads in these
/// motions, which is missing from the energy of a Solution. [force length] Collective.
/// \param carriesFreeBodies  also moves bodies without supports to where frictionless contact holds them; false with friction, which may
/// hold them elsewhere
double takeOutLift(const Comm& comm, const ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints,
                   bool carriesFreeBodies = true);

}  // namespace suture
