#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/pairing/ContactSurface.hpp>
#include <suture/solver/MakeSubdomains.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// A scene as objects: all that the stages of a simulation need of it.
struct Scene {
  /// The mesh on rank 0, elsewhere empty; its bodies are element groups. Collective.
  std::function<Mesh(const Comm&)> mesh;
  /// Rules, pairs and pieces of the mesh with its bodies, without laws. On rank 0.
  std::function<Constraints(const Mesh&)> constraints;
  ElasticModel model;
  std::vector<SubdomainKind> kinds;   ///< physics of each body; empty: all elastic
  std::vector<std::string> contacts;  ///< names of the contact lines
  LoadSteps steps{};                  ///< steps of the loads; empty: all at once
  bool isOneStep = false;             ///< the first of the steps alone is asked for
  ContactLaws laws;                   ///< laws of the contact lines; empty: frictionless
  SceneFile file;                     ///< settings of all packages, resolved, and where they come from, for the record of a run
  std::vector<Scene> levels;          ///< the scene on coarser meshes, the coarsest first, whose answers a nested start begins with

  const Parameters& settings() const { return *file.parameters; }
};

/// The objects of a scene file. Local, the same on all ranks.
/// \throws InputError  all that is wrong with materials, loads and levels of a nested start
Scene sceneOf(const SceneFile& file);

/// The same on several ranks, where a strategy of the user may fail on some of them: the error is the same on all. Collective.
Scene sceneOf(const Comm& comm, const SceneFile& file);

/// A scene made in C++. Local, the same on all ranks.
/// \param model  plane model, bodies and materials (addBody), loads, exact solution
/// \param mesh  called on rank 0; its element groups are the bodies, its side groups carry conditions, loads and contacts
/// \param conditions  displacements; loads are the model's
/// \param contacts  their names differ
/// \param settings  of all packages, as assignments "Outer Solver/Tolerance=1e-10", checked as those of --set; the others have their
/// defaults. A nested start takes its levels from Scene::levels.
/// \throws InputError  all of: settings that are none or that the objects give, no bodies, loads with a wrong number of expressions, two
/// contacts of one name
Scene makeScene(const ElasticModel& model, const std::function<Mesh()>& mesh, const std::vector<Condition>& conditions,
                const std::vector<Contact>& contacts, const std::vector<std::string>& settings = {});

}  // namespace suture
