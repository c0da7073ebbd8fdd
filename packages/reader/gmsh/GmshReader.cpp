#include <suture/base/Errors.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <suture/reader/gmsh/GeoStatements.hpp>
#include <suture/reader/gmsh/GeoText.hpp>
#include <suture/reader/gmsh/GmshAssembly.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>
#include <suture/reader/gmsh/MesherProcess.hpp>
#include <suture/reader/gmsh/MshReader.hpp>

#include <algorithm>
#include <filesystem>

namespace suture {

namespace {

void checkConstants(const GmshInput& input, Problems& problems) {
  if (input.constants.empty()) return;
  const std::vector<std::string> known = geoConstants(input.path);
  for (const auto& entry : input.constants)
    if (!std::binary_search(known.begin(), known.end(), entry.first))
      problems.add("Mesh/Constants/" + entry.first, "in " + input.path + ": " + unknownName("DefineConstant", entry.first, known));
}

Mesh meshGeometry(const GmshInput& input) {
  Problems problems;
  if (!input.allowPrograms) checkGeoStatements(input.path, problems);
  problems.throwIfAny();  // constants are looked up only if the statements are sound
  checkConstants(input, problems);
  problems.throwIfAny();
  const GeoWrapper wrapper(input.path, input.constants);
  Mesh mesh = assembleGmsh(runMesher({input.path, wrapper.path(), input.meshSizeFactor, input.seconds, input.allowPrograms}), input.path);
  numberAlongHilbertCurve(mesh);
  return mesh;
}

}  // namespace

// A .msh file keeps the user's numbering; a mesh generated here may be renumbered.
Mesh readGmsh(const GmshInput& input) {
  if (std::filesystem::path(input.path).extension() == ".geo") return meshGeometry(input);
  return assembleGmsh(readMsh(input.path), input.path);
}

}  // namespace suture
