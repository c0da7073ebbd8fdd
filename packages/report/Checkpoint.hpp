#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

/// Writes a checkpoint (HDF5) under a temporary name first: displacements of all nodes and the status of all contact pairs, in the mesh's
/// numbers, so that any number of ranks and any partition can go on from it. Collective. \throws EnvironmentError
/// \param meshHash  on rank 0: a checkpoint goes with one mesh
void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution);

/// Reads one for this rank's subdomains, with the status of all pairs. Collective.
/// \throws InputError  no checkpoint, damaged, or one of another mesh
Start readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes);

}  // namespace suture
