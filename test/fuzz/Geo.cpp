// Statements of a .geo file, as checked before Gmsh sees them.
#include "Fuzz.hpp"

#include <suture/reader/gmsh/GeoStatements.hpp>
#include <suture/reader/gmsh/GeoText.hpp>

using namespace suture;

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::string path = folder.file("a.geo", data, size);
  fuzz::accepts([&] { geoTokens(std::string(reinterpret_cast<const char*>(data), size), path); });
  fuzz::accepts([&] {
    Problems problems;
    checkGeoStatements(path, problems);
    problems.throwIfAny();
  });
  fuzz::accepts([&] { geoConstants(path); });
  beginsAsMsh(path);
  return 0;
}
