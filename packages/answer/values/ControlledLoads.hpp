#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Value of a solution for which a controlled load has a target: the mean displacement of its groups along its axis [length], or the force
/// that its body carries along its axis [force], computed as the mean of axis . stress . axis over the body times volume over length: by
/// virtual work this is the section force if all forces enter the body at the ends of that length. Collective.
/// \param displacement  of each mesh, without its lift: node-major, Cartesian
/// \throws InputError  if an element is folded
double controlledValue(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                       const std::vector<Vector>& displacement, const Load& load);

/// Change of a controlled value per amount of its load if everything else is rigid: the stiffness of a bolt [force / length]; for a mean
/// displacement the change when a force presses a cube of the stiffest material, a hundredth of the value of slender bodies or less [length
/// / force]. Collective.
double controlledSlope(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Load& load);

}  // namespace suture
