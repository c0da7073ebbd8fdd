#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/mesh/gmsh/GmshMesh.hpp>

namespace suture {

/// Makes the mesh of a scene of what Gmsh describes. Only nodes of elements are kept, in the order of their tags; elements in the order of
/// Gmsh's surfaces, each once, wherever the file repeats it for another group. Surfaces meshed clockwise as a whole are turned round. A
/// curve group without a name is left out when one of its elements is no side of the boundary. Local (rank 0).
/// \param file  path, for messages
/// \throws InputError  the problems of `gmsh`; a node outside the plane z = 0; an element of a named curve group that is no side of an
///                     element, or lies inside the material
Mesh assembleGmsh(GmshMesh gmsh, const std::string& file);

}  // namespace suture
