#pragma once
#include <suture/reader/cad/SideDescriptions.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <map>
#include <memory>
#include <string>

namespace suture {

/// Options of a scene for reading a .geo, .msh or CAD file.
struct GmshInput {
  std::string path;
  std::map<std::string, double> constants;   ///< override the values of DefineConstant (.geo only)
  double meshSizeFactor = 1.0;               ///< multiplies all mesh sizes (.geo only)
  double seconds = 600.0;                    ///< time limit of Gmsh; a tenth of it applies to the statements of the file (.geo only)
  bool allowPrograms = false;                ///< a .geo file may run programs, write files, ...: see checkGeoStatements()
  int order = 0;                             ///< order of the elements, 1 or 2; 0: as the .geo file says, 2 for CAD
  double largest = 0.0;                      ///< largest size of elements; 0: no limit [length] (.geo and CAD only)
  std::string cache{};                       ///< folder of meshes made before (MeshCache); empty: none (.geo and CAD only)
  std::string unit = "mm";                   ///< unit of length of the mesh: "mm", "m", "in", ... (CAD with units only)
  std::shared_ptr<const SizeField> sizes{};  ///< see MesherOrder::sizes
  bool simplices = false;                    ///< see MesherOrder::simplices
  bool mayTangle = false;                    ///< curved sides remain where they turn elements inside out, for callers who straighten them
};

/// Reads a .msh file (readMsh(), without Gmsh), or meshes a .geo or CAD file (cadFormat()) through libgmsh in a separate process
/// (runMesher()). Physical volumes, surfaces and curves become groups; in a CAD file solids and faces (CadNames.hpp). assembleGmsh()
/// documents the rest of the conversion. A mesh that was made before is taken from `cache`. Nodes of a .msh file keep the order of their
/// numbers; numberAlongHilbertCurve() numbers a mesh made by Gmsh. Local (rank 0). \throws InputError        all errors in the file or the
/// mesh; Gmsh's own errors; unknown constants (with nearest and known names); elements larger
///                           than `largest`, where the file prescribes their number
/// \throws EnvironmentError  a .geo or CAD file, and Suture was built without Gmsh (SUTURE_GMSH=OFF)
/// \param descriptions  of the side groups of a CAD file, if not null
Mesh readGmsh(const GmshInput& input, SideDescriptions* descriptions = nullptr);

/// Length of a unit in mm: "mm", "cm", "m", "um", "in", "ft"; 0 for any other. Local.
double millimetresOf(const std::string& unit);

}  // namespace suture
