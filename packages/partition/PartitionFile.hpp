#pragma once
#include <suture/base/hdf5/Hdf5File.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Partition/Type of a scene whose Mesh/File is cut already.
inline constexpr const char* kPartitionedMesh = "Partitioned Mesh";
Schema partitionedMeshSchema();

/// Parts of the scene that a cut mesh depends on (prescribed values and contact pairs are in it): name of the list -> its text.
using MadeFor = std::map<std::string, std::string>;

/// A mesh that is cut, from a file.
struct PartitionedMesh {
  Partition partition;              ///< placed on the ranks of this run; without subdomainOfElement
  std::vector<SubdomainMesh> mine;  ///< subdomains of this rank
  std::string remarks;              ///< bytes that the writer added, on all ranks
};

/// Adds the group /Partition to a mesh file being written by one rank: what is common (attribute Version, dataset Head), and the subdomains
/// one after the other (Subdomains; Ends, Checksums), so that each rank finds its own. Local.
void addPartition(Hdf5File& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const MadeFor& madeFor,
                  const std::string& remarks);

/// Reads it on any number of ranks, whatever the number that it was made on: each rank reads its own subdomains itself. Collective.
/// \throws InputError  no such file, no partition in it, one of another version or for another scene (names the lists that differ),
///                     truncated, damaged (by checksums)
PartitionedMesh readPartitionedMesh(const Comm& comm, const std::string& path, const MadeFor& madeFor, bool keepGroupsWhole);

}  // namespace suture
