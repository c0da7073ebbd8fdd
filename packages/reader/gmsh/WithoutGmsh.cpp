// Replaces MesherProcess.cpp when Suture is configured with SUTURE_GMSH=OFF.
#include <suture/base/Errors.hpp>
#include <suture/reader/gmsh/MesherProcess.hpp>

namespace suture {

std::string mesherProgram() { return ""; }

GmshMesh runMesher(const MesherOrder& order, std::vector<FileStamp>*) {
  throw EnvironmentError(
      "cannot mesh " + order.file +
      ": this Suture was built without Gmsh. Configure with -DSUTURE_GMSH=ON, or mesh the file elsewhere and read the .msh file");
}

}  // namespace suture
