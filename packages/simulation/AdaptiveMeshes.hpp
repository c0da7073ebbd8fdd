#pragma once
#include <suture/simulation/MeshSequence.hpp>
#include <suture/simulation/Scene.hpp>

namespace suture {

/// Reads the list `Accuracy` of a scene (Scene::accuracy). Local, the same on all ranks.
/// \throws InputError  all of: load steps, a partition in the mesh file, bodies with their own physics, a nested start; a quantity of an
/// unknown contact or condition
/// \param conditions  names of the boundary conditions that hold bodies
void requestAccuracy(Scene& scene, const std::vector<Contact>& contacts, const std::vector<std::string>& conditions);

}  // namespace suture
