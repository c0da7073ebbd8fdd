#pragma once
#include <suture/pairs/ContactSurface.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/accuracy/MeshSequence.hpp>
#include <suture/simulation/accuracy/PolygonSides.hpp>

namespace suture {

/// Meshes without a geometry: the scene's own mesh cut into triangles or tetrahedra, refined by bisection of marked elements, several
/// times for a mesh, by the errors that are expected on the way. Contact faces stay matching. Local, the same on all ranks.
/// \param scene  its mesh and bodies \param contacts  between two faces \param order  order of the elements
/// \param sides  of second-order elements
std::shared_ptr<MeshSequence> bisectedMeshes(const Scene& scene, std::vector<Contact> contacts, int order, PolygonSides sides);

}  // namespace suture
