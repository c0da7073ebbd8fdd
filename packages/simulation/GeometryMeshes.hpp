#pragma once
#include <suture/simulation/MeshSequence.hpp>
#include <suture/simulation/Scene.hpp>

namespace suture {

/// Meshes of a geometry (.geo, CAD) made by Gmsh: the first one coarser than that of the scene, the next ones by size fields. Sides of
/// second-order elements follow the geometry. Local, the same on all ranks.
/// \param scene  with its settings and constraints \param order  of the elements
std::shared_ptr<MeshSequence> geometryMeshes(const Scene& scene, int order);

}  // namespace suture
