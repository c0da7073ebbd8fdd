#include <suture/base/Collective.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/Regions.hpp>
#include <suture/simulation/MeanSupports.hpp>
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
    if (scene.coat) scene.coat(mesh);
  });
  return mesh;
}

Constraints readConstraints(const Comm& comm, const Mesh& mesh, const Scene& scene) {
  return onRoot(comm, "building the constraints", [&] {
    Constraints constraints = scene.constraints(
        mesh, [&](Condition& condition) { condition.movesFar = movesFar(scene); }, nullptr);
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
  ElasticModel resolved = model;
  collectivelyOnRoot(comm, "placing the loads", [&] { resolveLoads(mesh, resolved); });
  const MeanSupports needed = MeanSupports::find(comm, mesh, constraints, resolved, partition.bodiesAreConnected);
  if (needed.empty()) return;
  const MeanSupports::Held& first = needed.all().front();
  throw InputError(model.loads[static_cast<std::size_t>(first.load)].path,
                   "without it, body '" + model.bodies[static_cast<std::size_t>(first.body)] +
                       "' is not held: such a Mean Displacement needs the whole mesh, not a partitioned one. Solve the scene without "
                       "suture_partition, or prescribe displacements on this body");
}

}  // namespace suture
