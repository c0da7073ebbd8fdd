#pragma once
#include <suture/simulation/Scene.hpp>

namespace suture {

/// Refuses what a scene whose bodies move far cannot have. Local; nothing for other scenes. \throws InputError  lists all of it, with
/// advice
void checkMotion(const Scene& scene);
/// Refuses elastic supports of bodies that move far. Local (rank 0). \throws InputError  lists them, with advice
void checkSupports(const Scene& scene, const Mesh& mesh);

}  // namespace suture
