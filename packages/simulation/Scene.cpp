#include <suture/base/Expression.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/mesh/MeshReader.hpp>
#include <suture/report/Units.hpp>
#include <suture/simulation/NestedLevels.hpp>
#include <suture/simulation/Scene.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Scene sceneOf(const SceneFile& file) {
  Scene scene;
  scene.file = file;
  const Teuchos::RCP<const Parameters> all = file.parameters;
  scene.model = makeElasticModel(*all);
  scene.kinds = subdomainKinds(all->sublist("Bodies"));
  scene.contacts = sublistNames(all->sublist("Contact"));
  scene.laws = ContactLaws(all->sublist("Contact"));
  scene.mesh = [all, folder = file.folder](const Comm& comm) { return readMesh(comm, all->sublist("Mesh"), folder); };
  scene.constraints = [all, model = scene.model](const Mesh& mesh) {
    const auto compliance = [&](int element) {
      return contactCompliance(model.materialOf(mesh, element, mesh.bodyOfElement[element]), model.plane);
    };
    return buildConstraints(mesh, all->sublist("Boundary Conditions"), all->sublist("Contact"), sceneConstants(*all),
                            {compliance, unitsOf(*all).length});
  };
  for (const SceneFile& level : nestedLevels(file)) scene.levels.push_back(sceneOf(level));
  return scene;
}

}  // namespace suture
