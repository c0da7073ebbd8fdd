#pragma once
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/accuracy/MeshSequence.hpp>
#include <suture/simulation/accuracy/PolygonSides.hpp>

namespace suture {

/// Meshes of a geometry (.geo, CAD) made by Gmsh: the first one coarser than that of the scene, the next ones by size fields, which
/// also keep the effect of straight sides small. Local, the same on all ranks.
/// \param scene  with its settings and constraints \param order  of the elements \param sides  of second-order elements
std::shared_ptr<MeshSequence> geometryMeshes(const Scene& scene, int order, PolygonSides sides);

}  // namespace suture
