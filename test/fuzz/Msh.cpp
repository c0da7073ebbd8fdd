// A mesh file of Gmsh, text or binary.
#include "Fuzz.hpp"

#include <suture/reader/gmsh/GmshReader.hpp>

using namespace suture;

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::accepts([&] {
    GmshInput input;
    input.path = folder.file("mesh.msh", data, size);
    Mesh mesh = readGmsh(input);
    mesh.hash();
    assignBodies(mesh, mesh.elementGroupNames());
  });
  return 0;
}
