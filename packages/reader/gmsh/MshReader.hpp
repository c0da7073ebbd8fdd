#pragma once
#include <suture/reader/gmsh/GmshMesh.hpp>

#include <string>

namespace suture {

/// Reads a .msh file of Gmsh's formats 2.0 to 2.2 and 4.1, text or binary, without libgmsh. Local.
///
/// A part of GmshMesh is an entity in format 4.1, whose groups are listed in $Entities and $PartitionedEntities. In format 2 it is the
/// physical group that an element names, since other programs assign all elements to one entity. Physical groups without a name are called
/// "volume 2", "surface 7" or "curve 3". Other sections are skipped.
/// \throws InputError  every error in the file, with the section and the line (text) or byte (binary)
///
/// Source: Gmsh 4.8 Reference Manual, chapter 9, "MSH file format".
GmshMesh readMsh(const std::string& path);

}  // namespace suture
