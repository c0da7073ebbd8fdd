#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// `Generator` of scenes whose mesh is given by the program that uses the library (Scene::mesh); readMesh() refuses it.
constexpr const char* kGivenMesh = "Given";

/// Schema of the scene's list `Mesh`: File (.geo, .msh, .h5) or Generator with its own sublist; Constants and Mesh Size Factor for .geo.
Schema meshSchema();

/// Reads or generates the mesh on rank 0 (empty on the others). Collective.
/// \param mesh    the scene's list `Mesh`
/// \param folder  folder of relative file names
/// \throws InputError (missing or damaged file, unknown constant, nothing meshed), EnvironmentError (built without Gmsh)
Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder);

/// Path of the mesh file; empty for a Generator. Local. \throws InputError  as readMesh(), except errors in the file itself
std::string meshFile(const Parameters& mesh, const std::string& folder);

}  // namespace suture
