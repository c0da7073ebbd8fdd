#pragma once
#include <suture/simulation/MeshSequence.hpp>
#include <suture/simulation/Scene.hpp>

namespace suture {

/// Reads the list `Accuracy` of a scene (Scene::accuracy). Local, the same on all ranks.
/// \throws InputError  all of: load steps, a partition in the mesh file, bodies with their own physics, a nested start
void requestAccuracy(Scene& scene, const std::vector<Contact>& contacts);

}  // namespace suture
