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
  double seconds = 600.0;                   ///< time limit of Gmsh; a tenth of it applies to the statements of the file (.geo only)
  bool allowPrograms = false;               ///< a .geo file may run programs, write files, ...: see checkGeoStatements()
};

/// Reads a .msh file (readMsh(), without Gmsh), or meshes a .geo file through libgmsh in a separate process (runMesher()). Physical
/// volumes, surfaces and curves become groups; assembleGmsh() documents the rest of the conversion. Nodes of a .msh file keep the order of
/// their numbers; numberAlongHilbertCurve() numbers the mesh of a .geo file. Local (rank 0).
/// \throws InputError        all errors in the file or the mesh; Gmsh's own errors; unknown constants (with nearest and known names)
/// \throws EnvironmentError  a .geo file, and Suture was built without Gmsh (SUTURE_GMSH=OFF)
Mesh readGmsh(const GmshInput& input);

}  // namespace suture
