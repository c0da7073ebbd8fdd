#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Value of an answer that a controlled load has a target for: the mean displacement of its groups along its axis [length], or the force
/// that its body carries along its axis [force], the mean of axis . stress . axis over the body's volume times volume over length: by
/// virtual work the section force where all forces enter the body at the ends of that length. Collective.
/// \param displacement  of each mesh, beside its lift: node-major, Cartesian
/// \throws InputError  an element is folded
double controlledValue(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                       const std::vector<Vector>& displacement, const Load& load);

/// How much a controlled value changes with the amount of its load where nothing gives way: the stiffness of a bolt [force / length]; of a
/// mean displacement the change where a force presses a cube of the stiffest material, a hundredth of what slender bodies allow or less
/// [length / force]. Collective.
double controlledSlope(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Load& load);

}  // namespace suture
