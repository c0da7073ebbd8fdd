#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>

namespace suture {

/// Makes the mesh of a scene of what Gmsh describes: with volume elements one in space, whose sides are surface elements, without any a
/// plane one, whose sides are curve elements. Only nodes of elements are kept, in the order of their tags; elements in the order of Gmsh's
/// entities, each once, wherever the file repeats it for another group. Entities meshed inside out as a whole are turned round. A group of
/// sides without a name is left out when one of its elements is no side of the boundary. Local (rank 0).
/// \param file  path, for messages
/// \throws InputError  the problems of `gmsh`; a node of a plane mesh outside the plane z = 0; an element of a named group of sides that is
///                     no side of an element, or lies inside the material
Mesh assembleGmsh(GmshMesh gmsh, const std::string& file);

}  // namespace suture
