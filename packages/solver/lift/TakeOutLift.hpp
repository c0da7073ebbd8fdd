#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Takes rigid motions out of the scene, where it prescribes any (takeOutRigidMotions()): after the checks, before anything is assembled.
/// `constraints` of rank 0, for a method that needs the whole mesh, follow the meshes; they may be empty.
/// Returns the work of the loads in these motions, which the energy of a Solution lacks. [force length] Collective.
double takeOutLift(const Comm& comm, const ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints);

}  // namespace suture
