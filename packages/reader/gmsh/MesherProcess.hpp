#pragma once
#include <suture/base/FileStamp.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Task of suture_mesher.
struct MesherOrder {
  std::string file;             ///< the user's name of the file, for messages
  std::string opened;           ///< the .geo or CAD file that Gmsh opens
  double meshSizeFactor = 1.0;  ///< multiplies all mesh sizes
  double seconds = 600.0;       ///< total time limit; a tenth of it applies to the statements of the file
  bool allowPrograms = false;   ///< the file may run programs and write files
  int order = 0;                ///< order of the elements; 0: as the .geo file says, 2 for CAD
  double largest = 0.0;         ///< largest size of elements, without the factor; 0: no limit [length of the mesh]
  double scale = 1.0;           ///< length unit of the file (STEP and IGES: mm) over that of the mesh, for CAD
  /// Element sizes, which replace all those of the file, its factor and its numbers of elements (Transfinite, Layers); null: none.
  std::shared_ptr<const SizeField> sizes{};
  bool simplices = false;  ///< triangles and tetrahedra also where the file recombines them; numbers of elements are lifted there, too
};

/// Path of suture_mesher; "" if Suture was built without Gmsh. Local. \throws EnvironmentError  the program is missing
std::string mesherProgram();

/// Runs Gmsh in a separate process, suture_mesher (folder `suture` next to the library), with limits of time and memory, and reads the mesh
/// from a pipe. A process that ends without a mesh and without a message is an error. Local.
/// \param programs  if not null: the program and the libraries that it has loaded
/// \throws InputError        Gmsh's error message; a CAD file without a closed solid; a crash, an end without a result, or the time limit
/// \throws EnvironmentError  the program is missing or cannot be started; Suture was built without Gmsh (SUTURE_GMSH=OFF)
GmshMesh runMesher(const MesherOrder& order, std::vector<FileStamp>* programs = nullptr);

}  // namespace suture
