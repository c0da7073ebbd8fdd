#include <suture/base/Errors.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Phases.hpp>
#include <suture/simulation/moving/MotionCheck.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

const std::string kInsteadOfSprings =
    "the springs of an Elastic Support would turn with the body: use a Displacement, a Rigid Group or a Force";

/// Advice for what only a body that moves far cannot have.
std::string orSmall(const std::string& body) { return ", or give " + body + " Motion = Small if it stays near its drawn place"; }

}  // namespace

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
  const ElasticModel& model = scene.model;
  const auto moves = [&](const std::string& body) { return movesFar(scene, body); };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), moves))
    problems.add("Motion", "is Moving, but Motion of each body is Small: expected Small, or a body that moves");
  if (std::all_of(model.bodies.begin(), model.bodies.end(), moves))  // else checkSupports() finds their bodies
    for (const ElasticSupport& support : model.supports)
      refuse(true, "Boundary Conditions/" + support.name, kInsteadOfSprings + orSmall("its body"));
  for (const Load& load : model.loads)
    if (load.hasTensor())
      refuse(load.body.empty() ? std::any_of(model.bodies.begin(), model.bodies.end(), moves) : moves(load.body), load.path,
             "the axes of initial strains and stresses would turn with the body; a Temperature is possible" + orSmall("its body"));
  const auto checkLaws = [&](const std::vector<Material>& materials, const std::vector<std::string>& bodies) {
    for (std::size_t i = 0; i < materials.size(); ++i)
      refuse(materials[i].law && moves(bodies[i]), "Materials/" + materials[i].name + "/Type",
             "expected Isotropic: the axes of another law would turn with body '" + bodies[i] + "'" + orSmall("it"));
  };
  checkLaws(model.materialOfBody, model.bodies);
  checkLaws(model.materialOfRegion, model.bodyOfRegion);
  for (std::size_t body = 0; body < scene.kinds.size(); ++body)
    refuse(static_cast<bool>(scene.kinds[body].make) && scene.kinds[body].name != "Elastic", "Bodies/" + model.bodies[body] + "/Subdomain",
           "expected Elastic");
  problems.throwIfAny();
}

void checkSupports(const Scene& scene, const Mesh& mesh) {
  Problems problems;
  for (const ElasticSupport& support : scene.model.supports)
    for (const Side& side : sidesOf(mesh.sideGroups, support.groups)) {
      const std::string& body =
          mesh.bodies[static_cast<std::size_t>(mesh.bodyOfNode[static_cast<std::size_t>(mesh.nodesOf(side).front())])];
      if (!movesFar(scene, body)) continue;
      problems.add("Boundary Conditions/" + support.name,
                   "is not supported on body '" + body + "' with Motion = Moving; " + kInsteadOfSprings + orSmall("the body"));
      break;
    }
  problems.throwIfAny();
}

}  // namespace suture
