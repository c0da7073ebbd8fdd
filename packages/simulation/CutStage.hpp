#pragma once
#include <suture/constraints/PrescribedParts.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/solver/ProblemSize.hpp>

#include <string>
#include <vector>

namespace suture {

/// Properties of the whole mesh that later stages need.
struct Whole {
  ProblemSize size;                     ///< on all ranks; without the interface
  std::vector<ContactPiece> pieces;     ///< on rank 0
  std::string hash;                     ///< hash of the mesh, on rank 0
  std::vector<std::string> conditions;  ///< Constraints::conditions, on rank 0
  PrescribedParts prescribed{};         ///< on rank 0
  BoundaryParts parts{};                ///< likewise
};

/// Collective.
Whole wholeOf(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

/// The bodies as subdomains; each rank holds its own.
struct CutMesh {
  Partition partition;
  std::vector<SubdomainMesh> meshes;
  Whole whole;
};

/// True if the scene's mesh file contains a partition (Partition/Type = Partitioned Mesh). Local.
bool isCut(const Scene& scene);

/// Partitions mesh and constraints of rank 0, or reads the partition written by suture_partition. \throws InputError  Collective.
CutMesh cutMesh(const Comm& comm, const Scene& scene, const Mesh& mesh, const Constraints& constraints);

/// Adds the scene's partition to its mesh file (suture_partition). On rank 0.
void addCut(Hdf5Writer& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const Whole& whole,
            const Scene& scene);

/// Frees the whole mesh and its constraints on rank 0 once no later stage needs them. Local.
void forget(Mesh& mesh, Constraints& constraints, Partition& partition);

}  // namespace suture
