#include <suture/reader/MeshReader.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/accuracy/AdaptiveMeshes.hpp>
#include <suture/simulation/accuracy/BisectedMeshes.hpp>
#include <suture/simulation/accuracy/GeometryMeshes.hpp>
#include <suture/simulation/accuracy/QuantityError.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

int orderOf(const Scene& scene) {
  if (scene.accuracy->order > 0) return scene.accuracy->order;
  const Parameters& mesh = scene.settings().sublist("Mesh");
  return mesh.isParameter("Order") ? mesh.get<int>("Order") : 2;
}

bool hasPhases(const Parameters& settings) {
  const Parameters& steps = settings.sublist("Load Steps");
  for (const char* list : {"Removed", "Placed"})
    if (steps.isSublist(list) && steps.sublist(list).numParams() > 0) return true;
  return false;
}

void refuseOthers(const Scene& scene) {
  Problems problems;
  const auto refuse = [&](bool found, const std::string& why) {
    if (found) problems.add("Accuracy/Error", why);
  };
  refuse(
      hasPhases(scene.settings()),
      "needs the same bodies in all load steps, found Load Steps/Removed or Load Steps/Placed: the errors of bodies that do not exist at "
      "the end are not known. Remove Error, and refine the mesh by hand");
  refuse(isCut(scene), "needs the whole mesh, found Partition/Type = Partitioned Mesh; use the mesh without a partition, and METIS");
  refuse(std::any_of(scene.kinds.begin(), scene.kinds.end(), [](const SubdomainKind& kind) { return kind.name != "Elastic"; }),
         "needs elastic bodies: the error of a body with its own physics (Bodies/<body>/Subdomain) is not known");
  refuse(!scene.levels.empty(), "replaces Outer Solver/Start = Nested: each mesh starts from the previous one; remove Start");
  problems.throwIfAny();
}

bool hasGeometry(const Scene& scene) {
  const Parameters& mesh = scene.settings().sublist("Mesh");
  return (mesh.isParameter("File") || mesh.get<std::string>("Generator") != "None") && isGeometry(mesh, scene.file.folder);
}

}  // namespace

void requestAccuracy(Scene& scene, const std::vector<Contact>& contacts, const std::vector<std::string>& conditions,
                     const std::vector<std::string>& curved) {
  std::optional<AccuracyRequest> request = AccuracyRequest::of(scene.settings());
  if (!request) return;
  const Scene plain = scene;
  checkQuantity(*request, conditions, scene.entries());
  scene.accuracy = request;
  refuseOthers(scene);
  const int order = orderOf(scene);
  const PolygonSides sides = order == 2 && !request->keepsCurves ? PolygonSides(curved) : PolygonSides();
  scene.meshes = hasGeometry(scene) ? geometryMeshes(plain, order, sides) : bisectedMeshes(plain, contacts, order, sides);
  scene.mesh = [meshes = scene.meshes](const Comm& comm) { return meshes->start(comm); };
}

}  // namespace suture
