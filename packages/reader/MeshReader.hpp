#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// The scene's list `Mesh`: File (.geo, .msh, .h5) or Generator with its own sublist; Constants and Mesh Size for .geo.
Schema meshSchema();

/// Reads or generates the mesh on rank 0 (empty on the others). Collective.
/// \param mesh    the scene's list `Mesh`
/// \param folder  folder that relative file names start from
/// \throws InputError (missing or damaged file, unknown constant, nothing meshed), EnvironmentError (built without Gmsh)
Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder);

/// Path of that file; empty for a Generator. Local. \throws InputError  as above, but for the file itself
std::string meshFile(const Parameters& mesh, const std::string& folder);

}  // namespace suture
