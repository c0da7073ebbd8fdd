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
  double seconds = 600.0;                   ///< time limit of Gmsh; a tenth of it for the statements of a .geo file
  bool allowPrograms = false;               ///< a .geo file may run programs, write files, ...: see checkGeoStatements()
};

/// Reads a .msh file, or meshes a .geo file, through libgmsh. Only named physical surfaces and curves become groups; only nodes of
/// elements are kept: of a .msh file in the order of its numbers, of a .geo file as numberAlongHilbertCurve() says. Surfaces meshed
/// clockwise as a whole are turned round. Gmsh runs in a process of its own (MesherProcess).
/// Local (rank 0).
/// \throws InputError        Gmsh's own errors; unknown constants (nearest, known); no elements; a cell of another kind; a node outside the
///                           plane z = 0; a curve element that is no side of an element, or lies inside the material
/// \throws EnvironmentError  Suture was built without Gmsh (SUTURE_GMSH=OFF)
Mesh readGmsh(const GmshInput& input);

}  // namespace suture
