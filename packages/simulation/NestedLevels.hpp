#pragma once
#include <suture/simulation/Scene.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
#include <vector>

namespace suture {

class Monitor;

/// The scene files of the coarser levels of `Outer Solver/Start = Nested`, coarsest first; empty for any other start. Each level is the
/// scene with the overrides listed in `Outer Solver/Nested/Levels`. Local. \throws InputError  a level is not a valid scene
std::vector<SceneFile> nestedLevels(const SceneFile& file);

/// Solves the scene on each level, starting each from the previous one, and interpolates the last solution to `meshes`. Collective.
/// \param scene  with levels  \throws NumericalError  a level does not converge
Start startFromLevels(const CommPtr& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, Monitor& monitor);

}  // namespace suture
