#pragma once
#include <suture/simulation/Scene.hpp>

namespace suture {

/// Prepares a scene with the list `Accuracy` for a sequence of meshes: its first mesh, of second order unless the settings give an order,
/// and Scene::remesh. No effect without a request. Local, the same on all ranks.
/// \throws InputError  all of: load steps, a partition in the mesh file, bodies with their own physics, a nested start, an unknown quantity
void prepareAccuracy(Scene& scene);

}  // namespace suture
