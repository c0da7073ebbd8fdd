#pragma once
#include <suture/reader/gmsh/GmshMesh.hpp>

#include <string>

namespace suture {

/// Task of suture_mesher.
struct MesherOrder {
  std::string file;             ///< the user's name of the file, for messages
  std::string opened;           ///< the .geo file that Gmsh opens
  double meshSizeFactor = 1.0;  ///< multiplies all mesh sizes
  double seconds = 600.0;       ///< total time limit; a tenth of it applies to the statements of the file
  bool allowPrograms = false;   ///< the file may run programs and write files
};

/// Runs Gmsh in a separate process, suture_mesher (folder `suture` next to the library), with limits of time and memory, and reads the mesh
/// from a pipe. A process that ends without a mesh and without a message is an error. Local.
/// \throws InputError        Gmsh's error message; a crash, an end without a result, or the time limit
/// \throws EnvironmentError  the program is missing or cannot be started; Suture was built without Gmsh (SUTURE_GMSH=OFF)
GmshMesh runMesher(const MesherOrder& order);

}  // namespace suture
