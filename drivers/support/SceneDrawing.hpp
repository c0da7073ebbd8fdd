#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/Mesh.hpp>

#include <filesystem>
#include <string>

#include "SolveOptions.hpp"

namespace suture {

/// --check: the picture of a scene by suture_plot, which runs as a child of rank 0. A drawing that fails is reported, and is no error of
/// the check.
class SceneDrawing {
 public:
  /// Stores the scene in a temporary file, unless the options want no drawing. Collective. \param mesh  on rank 0
  SceneDrawing(const Comm& comm, const SolveOptions& options, const SceneFile& scene, const Mesh& mesh);
  ~SceneDrawing();  ///< removes the file
  SceneDrawing(const SceneDrawing&) = delete;
  SceneDrawing& operator=(const SceneDrawing&) = delete;

  /// Draws into the output folder of the scene, and prints the paths of the pictures, or why there are none and how to draw them. Local
  /// (rank 0; nothing happens on the others).
  void draw(std::ostream* console) const;

 private:
  std::string command_;           // that draws the scene
  std::string output_;            // folder of the pictures
  std::filesystem::path folder_;  // temporary; empty: nothing is drawn
  std::string missing_;           // reason why nothing is drawn, or empty
};

}  // namespace suture
