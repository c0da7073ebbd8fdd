#pragma once
#include <suture/mesh/Mesh.hpp>

#include <map>
#include <string>

namespace suture {

/// Options of a scene for reading a .geo or .msh file.
struct GmshInput {
  std::string path;
  std::map<std::string, double> constants;  ///< override the values of DefineConstant (.geo only)
  double meshSizeFactor = 1.0;              ///< multiplies all mesh sizes (.geo only)
  double seconds = 600.0;                   ///< time limit of Gmsh; a tenth of it for the statements of the file (.geo only)
  bool allowPrograms = false;               ///< a .geo file may run programs, write files, ...: see checkGeoStatements()
};

/// Reads a .msh file (readMsh(), without Gmsh), or meshes a .geo file through libgmsh in a process of its own (runMesher()). Physical
/// volumes, surfaces and curves become groups; assembleGmsh() tells what else becomes of the mesh. Nodes keep the order of their numbers in
/// a .msh file; a mesh that is made of a .geo file is numbered by numberAlongHilbertCurve(). Local (rank 0).
/// \throws InputError        everything that is wrong with the file or with the mesh; Gmsh's own errors; unknown constants (nearest, known)
/// \throws EnvironmentError  a .geo file, and Suture was built without Gmsh (SUTURE_GMSH=OFF)
Mesh readGmsh(const GmshInput& input);

}  // namespace suture
