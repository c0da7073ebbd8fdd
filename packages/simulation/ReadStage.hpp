#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/simulation/Scene.hpp>

#include <vector>

namespace suture {

/// Reads the mesh of a scene and its bodies, on rank 0. \throws InputError  Collective.
Mesh readBodies(const Comm& comm, const Scene& scene);

/// Builds rules, pairs and pieces of a scene's mesh, on rank 0. \throws InputError  Collective.
Constraints readConstraints(const Comm& comm, const Mesh& mesh, const Scene& scene);

/// Checks that elements are compatible with their materials, in the whole mesh on rank 0 or in the subdomains of each rank.
/// \throws InputError  names material and body. Collective.
void checkElements(const Comm& comm, const Mesh& mesh, const ElasticModel& model);
void checkElements(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// Checks that a scene with a partitioned mesh has a solution, before its mesh is partitioned. \throws InputError  names the body and its
/// free motion; a body that only mean displacements hold. Collective.
/// \param partition  of the mesh; provides whether its bodies are known to be connected
void checkSolvability(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                      const Partition& partition);

}  // namespace suture
