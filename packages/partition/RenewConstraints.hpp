#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Replaces rules, supports, rigid groups and contact of the subdomains by other constraints of a mesh with the same elements, as
/// distribute() would give them. Cost proportional to the constraints. Collective.
/// \param mesh, constraints  on rank 0  \param meshes  of this rank, from distribute()
/// \return false, with the same meshes as before: the masters of rigid groups differ, and with them the nodes of subdomains
bool renewConstraints(const Comm& comm, const Mesh& mesh, const Constraints& constraints, std::vector<SubdomainMesh>& meshes);

}  // namespace suture
