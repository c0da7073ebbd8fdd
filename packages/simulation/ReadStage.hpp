#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/simulation/Scene.hpp>

#include <vector>

namespace suture {

/// The mesh of a scene with its bodies, on rank 0. \throws InputError  Collective.
Mesh readBodies(const Comm& comm, const Scene& scene);

/// Rules, pairs and pieces of a scene's mesh, on rank 0. \throws InputError  Collective.
Constraints readConstraints(const Comm& comm, const Mesh& mesh, const Scene& scene);

/// Checks that elements go with their materials, in the whole mesh on rank 0 or in each rank's own. \throws InputError  names material and
/// body. Collective.
void checkElements(const Comm& comm, const Mesh& mesh, const ElasticModel& model);
void checkElements(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// Checks that a scene has a solution. \throws InputError  names the body and where it can move. Collective.
/// \param partition  of the mesh: whether its bodies are known to be connected
void checkSolvability(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                      const Partition& partition);

}  // namespace suture
