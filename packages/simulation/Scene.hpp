#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
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
  ContactLaws laws;                   ///< laws of the contact lines; empty: frictionless
  SceneFile file;                     ///< settings of all packages, resolved, and where they come from, for the record of a run
  std::vector<Scene> levels;          ///< the scene on coarser meshes, the coarsest first, whose answers a nested start begins with

  const Parameters& settings() const { return *file.parameters; }
};

/// The objects of a scene file. Local, the same on all ranks.
/// \throws InputError  all that is wrong with materials, loads and levels of a nested start
Scene sceneOf(const SceneFile& file);

}  // namespace suture
