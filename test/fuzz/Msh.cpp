// A mesh file of Gmsh, through the mesher in its own process: a few inputs a second.
#include "Fuzz.hpp"

#include <suture/mesh/gmsh/GmshReader.hpp>

using namespace suture;

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::accepts([&] {
    GmshInput input;
    input.path = folder.file("mesh.msh", data, size);
    input.seconds = 20.0;
    Mesh mesh = readGmsh(input);
    mesh.hash();
    assignBodies(mesh, mesh.elementGroupNames());
  });
  return 0;
}
