#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>

namespace suture {

/// Assembles a scene's mesh from Gmsh's data: 3D if there are volume elements, with surface elements as sides; otherwise 2D, with curve
/// elements as sides. Keeps only the nodes of elements, in the order of their tags, and elements in the order of Gmsh's entities, each
/// once, even if the file repeats it for another group. Entities meshed inside out as a whole are reversed. An unnamed side group is
/// omitted if one of its elements is not a boundary side. Local (rank 0).
/// \param file  path, for messages
/// \throws InputError  the problems of `gmsh`; a node of a 2D mesh outside the plane z = 0; an element of a named side group that is
///                     not a side of an element, or lies inside the material
Mesh assembleGmsh(GmshMesh gmsh, const std::string& file);

}  // namespace suture
