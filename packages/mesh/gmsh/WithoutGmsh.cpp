// Stands for GmshReader.cpp when Suture is configured with SUTURE_GMSH=OFF.
#include <suture/base/Errors.hpp>
#include <suture/mesh/gmsh/GmshReader.hpp>

namespace suture {

Mesh readGmsh(const GmshInput& input) {
  throw EnvironmentError("cannot read " + input.path +
                         ": this Suture was built without Gmsh. Configure with -DSUTURE_GMSH=ON, or convert the mesh to .h5 elsewhere");
}

}  // namespace suture
