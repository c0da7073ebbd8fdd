#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Solution.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// State of an unfinished run: displacements of all nodes and the state of all contact pairs, in the mesh's numbers, so that any number
/// of ranks and any partition can go on from it.
struct Checkpoint {
  std::vector<Vector> displacement;    ///< displacements of each subdomain of this rank: beside its lift, node-major, Cartesian [length]
  std::map<int, ContactState> status;  ///< pair id -> state; on all ranks
};

/// Writes a checkpoint (HDF5) under a temporary name first. Collective. \throws EnvironmentError
/// \param meshHash  on rank 0: a checkpoint goes with one mesh
void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution);

/// Reads one for this rank's subdomains. Collective.
/// \throws InputError  no checkpoint, damaged, or one of another mesh
Checkpoint readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes);

}  // namespace suture
