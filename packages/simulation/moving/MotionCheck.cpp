#include <suture/base/Errors.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Phases.hpp>
#include <suture/simulation/moving/MotionCheck.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void checkMotion(const Scene& scene) {
  if (!movesFar(scene)) return;
  Problems problems;
  const auto refuse = [&](bool found, const std::string& path, const std::string& advice) {
    if (found) problems.add(path, "is not supported with Motion = Moving; " + advice);
  };
  const Parameters& settings = scene.settings();
  if (scene.steps.empty())
    problems.add("Load Steps/Times", "is missing: Motion = Moving is a path of load steps; expected for instance {1, 2, 3}");
  refuse(scene.model.axisymmetric, "Model", "expected Plane Strain, Plane Stress or Solid");
  refuse(scene.accuracy.has_value(), "Accuracy/Error", "choose the mesh, and Output/Error Estimate");
  refuse(hasControlledLoads(scene), "Boundary Conditions", "instead of Mean Displacement and Preload use a Rigid Group or a Force");
  refuse(!scene.lines.empty(), "Contact", "leave Pressure Overclosure out");
  refuse(isCut(scene), "Partition/Type", "each step makes its own contact pairs, so that the scene must cut its mesh itself");
  refuse(settings.get<std::string>("Formulation") != "Contact On The Interface", "Formulation",
         "expected Contact On The Interface, or Outer Solver/Type = Monolithic");
  refuse(!scene.levels.empty(), "Outer Solver/Start", "expected another value than Nested");
  refuse(settings.sublist("Output").get<bool>("Error Bound"), "Output/Error Bound", "use Output/Error Estimate");
  refuse(!Phases(scene).empty(), "Load Steps", "bodies cannot be removed or placed");
  for (const ElasticSupport& support : scene.model.supports)
    refuse(true, "Boundary Conditions/" + support.name,
           "the springs of an Elastic Support would turn with the body: use a Displacement, a Rigid Group or a Force");
  for (const Load& load : scene.model.loads)
    refuse(load.kind == Load::Kind::InitialStress || load.kind == Load::Kind::InitialStrain, load.path,
           "the axes of initial strains and stresses would turn with the body; a Temperature is possible");
  for (const std::vector<Material>* materials : {&scene.model.materialOfBody, &scene.model.materialOfRegion})
    for (const Material& material : *materials)
      refuse(material.law != nullptr, "Materials/" + material.name + "/Type",
             "expected Isotropic: the axes of another law would turn with the body");
  for (std::size_t body = 0; body < scene.kinds.size(); ++body)
    refuse(static_cast<bool>(scene.kinds[body].make) && scene.kinds[body].name != "Elastic",
           "Bodies/" + scene.model.bodies[body] + "/Subdomain", "expected Elastic");
  problems.throwIfAny();
}

}  // namespace suture
