#include "SceneDataFile.hpp"

#include <suture/base/Collective.hpp>
#include <suture/base/Expression.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/report/SceneData.hpp>
#include <suture/simulation/ReadStage.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <iostream>

#include "Program.hpp"

namespace suture {

namespace {

/// Adds the side groups of contacts that the mesh does not have.
void checkSides(const Mesh& mesh, const Parameters& contacts, Problems& problems) {
  for (auto entry = contacts.begin(); entry != contacts.end(); ++entry) {
    const std::string& name = contacts.name(entry);
    if (!contacts.isSublist(name)) continue;
    const Parameters& contact = contacts.sublist(name);
    for (const char* side : {"Side A", "Side B"})
      for (const std::string& group : groupNames(contact, side))
        if (const std::string problem = sideGroupProblem(mesh, group); !problem.empty())
          problems.add("Contact/" + name + "/" + side, problem);
  }
}

}  // namespace

RunResult writeSceneDataFile(const Comm& comm, const Scene& scene, const SolveOptions& options) {
  const Mesh mesh = readBodies(comm, scene);
  const Parameters& all = scene.settings();
  collectivelyOnRoot(comm, "checking the names in the scene", [&] {
    Problems problems;
    readConditions(mesh, all.sublist("Boundary Conditions"), sceneConstants(all), problems);
    checkSides(mesh, all.sublist("Contact"), problems);
    problems.throwIfAny();
  });
  writeSceneData(comm, mesh, scene.file, options.sceneData);
  if (std::ostream* console = consoleOf(comm, options.quiet)) *console << options.sceneData << std::endl;
  return {};
}

}  // namespace suture
