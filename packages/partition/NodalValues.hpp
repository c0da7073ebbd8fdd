#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Values of all nodes of a mesh, node-major, from those of its subdomains; on rank 0, empty on other ranks. Collective.
/// \param values  of each mesh of this rank, node-major  \param nodes  of the whole mesh, on rank 0
/// \param dimension  of the mesh, the same on all ranks
Vector gatherNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& values, int nodes, int dimension);

/// Values of the nodes of each mesh of this rank, node-major. Collective.
/// \param whole  values of all nodes, on rank 0  \param dimension  of the mesh, on rank 0
std::vector<Vector> scatterNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Vector& whole, int dimension);

}  // namespace suture
