#pragma once
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Partition/Type of a scene whose Mesh/File is already partitioned.
inline constexpr const char* kPartitionedMesh = "Partitioned Mesh";
Schema partitionedMeshSchema();

/// Parts of the scene that a partitioned mesh depends on (it contains prescribed values and contact pairs): name of the list -> its text.
using MadeFor = std::map<std::string, std::string>;

/// A partitioned mesh from a file.
struct PartitionedMesh {
  Partition partition;              ///< placed on the ranks of this run; without subdomainOfElement
  std::vector<SubdomainMesh> mine;  ///< subdomains of this rank
  std::string remarks;              ///< bytes that the writer added, on all ranks
};

/// Adds the group /Partition to a mesh file being written by one rank: the common data (attribute Version, dataset Head), and the
/// subdomains one after the other (Subdomains; Ends, Checksums), which lets each rank find its own. Local.
void addPartition(Hdf5Writer& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const MadeFor& madeFor,
                  const std::string& remarks);

/// Reads a partitioned mesh on any number of ranks, independent of the number that wrote it. Each rank reads its own subdomains.
/// Collective.
/// \throws InputError  no such file, no partition in it, another version or another scene (names the lists that differ), truncated,
///                     damaged (by checksums)
PartitionedMesh readPartitionedMesh(const Comm& comm, const std::string& path, const MadeFor& madeFor, bool keepGroupsWhole);

}  // namespace suture
