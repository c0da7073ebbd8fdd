#pragma once
#include <suture/simulation/Scene.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
#include <vector>

namespace suture {

class Monitor;

/// The scene files of the coarser levels of `Outer Solver/Start = Nested`, the coarsest first; none for another start. Each is the scene
/// with the changes that its text in `Outer Solver/Nested/Levels` names. Local. \throws InputError  a level that is no scene
std::vector<SceneFile> nestedLevels(const SceneFile& file);

/// Solves the scene on each of its levels, one from the other, and carries the last answer to these meshes. Collective.
/// \param scene  with levels  \throws NumericalError  a level does not converge
Start startFromLevels(const CommPtr& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, Monitor& monitor);

}  // namespace suture
