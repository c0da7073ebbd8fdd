#include <suture/answer/solvability/Solvability.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/Regions.hpp>
#include <suture/simulation/ReadStage.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Mesh readBodies(const Comm& comm, const Scene& scene) {
  Mesh mesh = scene.mesh(comm);
  collectivelyOnRoot(comm, "checking the mesh", [&] {
    requireDimension(mesh, mesh.source, scene.model);
    assignBodies(mesh, scene.model.bodies);
    assignRegions(mesh, scene.settings().sublist("Bodies"));
    if (scene.model.axisymmetric) makeAxisymmetric(mesh);
  });
  return mesh;
}

Constraints readConstraints(const Comm& comm, const Mesh& mesh, const Scene& scene) {
  return onRoot(comm, "building the constraints", [&] {
    Constraints constraints = scene.constraints(mesh);
    applyLaws(scene.laws, mesh, constraints);
    constraints.notes.insert(constraints.notes.begin(), mesh.notes.begin(), mesh.notes.end());
    return constraints;
  });
}

void checkElements(const Comm& comm, const Mesh& mesh, const ElasticModel& model) {
  collectivelyOnRoot(comm, "checking the elements", [&] {
    Problems problems;
    checkElements(
        mesh, [&](int element) { return mesh.bodyOfElement[element]; }, model, problems);
    problems.throwIfAny();
  });
}

void checkElements(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model) {
  collectively(comm, "checking the elements", [&] {
    Problems problems;
    for (const SubdomainMesh& mesh : meshes)
      checkElements(
          mesh, [&](int) { return mesh.body; }, model, problems);
    problems.throwIfAny();
  });
}

void checkSolvability(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                      const Partition& partition) {
  collectivelyOnRoot(comm, "checking that the scene has a solution", [&] {
    ElasticModel resolved = model;  // suture_partition calls this before the mesh is partitioned
    resolveLoads(mesh, resolved);
    checkSolvability(mesh, constraints, resolved, partition.bodiesAreConnected);
  });
}

}  // namespace suture
