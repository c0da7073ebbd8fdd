#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/solver/MakeSubdomains.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

class MeshSequence;

/// A scene as objects: everything that the stages of a simulation need.
struct Scene {
  /// The mesh on rank 0, empty on other ranks; its bodies are element groups. Collective.
  std::function<Mesh(const Comm&)> mesh;
  /// Adds the coatings of softened contacts to the mesh with its bodies; on rank 0. Empty: there are none.
  std::function<void(Mesh&)> coat{};
  /// Rules, pairs and pieces of the mesh with its bodies, without contact laws; see buildConstraints(). On rank 0.
  std::function<Constraints(const Mesh&, const ConditionChange&, KeptChoices*)> constraints;
  ElasticModel model;
  std::vector<SubdomainKind> kinds;           ///< physics of each body; empty: all elastic
  std::vector<std::string> contacts;          ///< names of the contact lines; the springs of a softened contact are lines of one name
  std::vector<ContactLine> lines{};           ///< contact lines; empty: none is softened
  LoadSteps steps{};                          ///< load steps; empty: all loads at once
  bool isOneStep = false;                     ///< only the first step is requested
  ContactLaws laws;                           ///< laws of the contact lines; empty: frictionless
  SceneFile file;                             ///< resolved settings of all packages and their origin, for the record of a run
  std::vector<Scene> levels;                  ///< the scene on coarser meshes for a nested start, coarsest first
  std::optional<AccuracyRequest> accuracy{};  ///< nothing: the scene is solved on its own mesh
  std::shared_ptr<MeshSequence> meshes{};     ///< with `accuracy`: the meshes, of which `mesh` makes the first one

  const Parameters& settings() const { return *file.parameters; }
  /// Names of the entries of the list `Contact`.
  std::vector<std::string> entries() const;
};

/// True if bodies of the scene move far (Motion = Moving).
bool movesFar(const Scene& scene);
/// True if this body does: not one whose own Motion is Small.
bool movesFar(const Scene& scene, const std::string& body);

/// Creates the objects of a scene file. Local, the same on all ranks.
/// \throws InputError  lists all errors in materials, loads and levels of a nested start
Scene sceneOf(const SceneFile& file);

/// The same on several ranks. If a user-defined strategy fails on some ranks, all ranks throw the same error. Collective.
Scene sceneOf(const Comm& comm, const SceneFile& file);

/// Creates a scene in C++. Local, the same on all ranks.
/// \param model  plane model, bodies and materials (addBody), loads, exact solution
/// \param mesh  called on rank 0; its element groups are the bodies, its side groups carry conditions, loads and contacts
/// \param conditions  displacements only; loads belong to the model
/// \param contacts  with distinct names
/// \param settings  of all packages, as assignments "Outer Solver/Tolerance=1e-10", checked as those of --set; defaults apply otherwise. A
/// nested start takes its levels from Scene::levels.
/// \throws InputError  lists all of: invalid settings, settings that the objects define, no bodies, loads with a wrong number of
/// expressions, duplicate contact names
Scene makeScene(const ElasticModel& model, const std::function<Mesh()>& mesh, const std::vector<Condition>& conditions,
                const std::vector<Contact>& contacts, const std::vector<std::string>& settings = {});

}  // namespace suture
