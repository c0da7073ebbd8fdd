#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Converts loads that depend on the mesh into loads that act element by element:
/// - Force F: the traction F / A, A the area of its groups (length in 2D, of the whole circle in axisymmetric scenes);
/// - Moment M: the traction spin x (x - c), c the groups' centroid, J spin = M, J the integral of |r|^2 I - r r^T with r = x - c. It has no
/// resultant, and on a straight side across a beam it is the linear bending stress;
/// - ReferenceForce: forces t + r x a on the nodes of its groups, a the position relative to their mean, with the given resultant: on a
/// rigid group every distribution with this resultant is the same load;
/// - Point Force: the nearest node; among several equally near nodes of one body the lowest number.
///
/// The meshes are those of one scene, before rigid motions are taken out. Collective; the model is the same on all ranks, before and after.
/// \throws InputError  lists all of: no node within the tolerance of a point (nearest node, its distance), nodes of several bodies there,
/// an unknown body
void resolveLoads(const Comm& comm, const std::vector<SubdomainMesh>& meshes, ElasticModel& model);

/// The same on a whole mesh. Local.
void resolveLoads(const Mesh& mesh, ElasticModel& model);

}  // namespace suture
