#pragma once
#include <suture/reader/gmsh/GmshMesh.hpp>

#include <string>

namespace suture {

/// Task of suture_mesher.
struct MesherOrder {
  std::string file;             ///< as the user knows it, for messages
  std::string opened;           ///< file that Gmsh opens: a .geo file
  double meshSizeFactor = 1.0;  ///< multiplies all mesh sizes
  double seconds = 600.0;       ///< for all; a tenth of it for the statements of the file
  bool allowPrograms = false;   ///< the file may run programs and write files
};

/// Runs Gmsh in a process of its own, suture_mesher, which lies in the folder `suture` beside the library, with limits of time and memory;
/// reads the mesh from a pipe. A process that ends without a mesh and without a message is an error. Local.
/// \throws InputError        Gmsh's complaint; a crash, an end without a result or too long a time: says so
/// \throws EnvironmentError  the program is missing or cannot be started; Suture was built without Gmsh (SUTURE_GMSH=OFF)
GmshMesh runMesher(const MesherOrder& order);

}  // namespace suture
