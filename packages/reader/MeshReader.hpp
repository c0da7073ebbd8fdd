#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <memory>
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

/// Changes of the options in a list `Mesh` for a file that Gmsh meshes.
struct MeshChanges {
  double factor = 1.0;                       ///< multiplies all sizes
  int order = 0;                             ///< order of the elements where the list has none; 0: no change
  bool simplices = false;                    ///< triangles and tetrahedra only
  bool mayTangle = false;                    ///< see GmshInput::mayTangle
  std::shared_ptr<const SizeField> sizes{};  ///< replaces all sizes and numbers of elements; on rank 0
};

/// True if Gmsh makes the mesh from a geometry (.geo or CAD), so that readMesh() obeys MeshChanges. Local. \throws InputError  as
/// meshFile()
bool isGeometry(const Parameters& mesh, const std::string& folder);

/// Meshes a geometry with other options than those of the scene. Collective. \throws  as readMesh()
Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder, const MeshChanges& changes);

/// Path of the mesh file; empty for a Generator. Local. \throws InputError  as readMesh(), except errors in the file itself
std::string meshFile(const Parameters& mesh, const std::string& folder);

}  // namespace suture
