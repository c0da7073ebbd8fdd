#pragma once
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/accuracy/MeshSequence.hpp>

namespace suture {

/// Reads the list `Accuracy` of a scene (Scene::accuracy). Local, the same on all ranks.
/// \param contacts  between two faces \param conditions  names of the boundary conditions that hold bodies
/// \param curved  side groups whose second-order sides stay curved: contacts and sliding supports, whose gaps and directions follow the
/// geometry
/// \throws InputError  all of: bodies removed or placed on the load path, a partition in the mesh file, bodies with their own physics, a
/// nested start; a quantity of an unknown contact or condition
void requestAccuracy(Scene& scene, const std::vector<Contact>& contacts, const std::vector<std::string>& conditions,
                     const std::vector<std::string>& curved);

}  // namespace suture
