#pragma once
#include <suture/constraints/PrescribedParts.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/solver/ProblemSize.hpp>

#include <string>
#include <vector>

namespace suture {

/// Properties of the whole scene that later stages need.
struct Whole {
  ProblemSize size;                     ///< on all ranks; without the interface
  std::vector<ContactPiece> pieces;     ///< on rank 0
  std::string hash;                     ///< hash of the mesh, on rank 0
  std::vector<std::string> conditions;  ///< Constraints::conditions, on rank 0
  PrescribedParts prescribed{};         ///< on rank 0
};

/// Collective.
Whole wholeOf(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

/// The bodies in subdomains, each rank with its own.
struct CutMesh {
  Partition partition;
  std::vector<SubdomainMesh> meshes;
  Whole whole;
};

/// True if the scene's mesh file is cut already (Partition/Type = Partitioned Mesh). Local.
bool isCut(const Scene& scene);

/// Cuts mesh and constraints of rank 0, or reads what suture_partition has cut. \throws InputError  Collective.
CutMesh cutMesh(const Comm& comm, const Scene& scene, const Mesh& mesh, const Constraints& constraints);

/// For suture_partition: adds the cut of the scene to its mesh file. On rank 0.
void addCut(Hdf5File& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const Whole& whole,
            const Scene& scene);

/// Frees what rank 0 holds in proportion to the whole mesh, where no later stage needs it. Local.
void forget(Mesh& mesh, Constraints& constraints, Partition& partition);

}  // namespace suture
