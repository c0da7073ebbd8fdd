#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Replaces rules, supports, rigid groups and contact of the subdomains by other constraints of a mesh with the same elements, as
/// distribute() would give them. Cost proportional to the constraints. Collective.
/// \param mesh, constraints  on rank 0; the masters of rigid groups are among the RigidGroup::positionNodes of the constraints given to
/// distribute(), or the same as there  \param meshes  of this rank, from distribute()
void renewConstraints(const Comm& comm, const Mesh& mesh, const Constraints& constraints, std::vector<SubdomainMesh>& meshes);

}  // namespace suture
