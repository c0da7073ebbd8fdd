#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/gmsh/FlatTriangles.hpp>
#include <suture/reader/gmsh/GeoStatements.hpp>
#include <suture/reader/gmsh/GeoText.hpp>
#include <suture/reader/gmsh/GmshAssembly.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>
#include <suture/reader/gmsh/MeshCache.hpp>
#include <suture/reader/gmsh/MeshKey.hpp>
#include <suture/reader/gmsh/MesherProcess.hpp>
#include <suture/reader/gmsh/MshReader.hpp>
#include <suture/reader/gmsh/StraightSides.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace suture {

namespace {

void checkConstants(const GmshInput& input, Problems& problems) {
  if (input.constants.empty()) return;
  const std::vector<std::string> known = geoConstants(input.path);
  for (const auto& entry : input.constants)
    if (!std::binary_search(known.begin(), known.end(), entry.first))
      problems.add("Mesh/Constants/" + entry.first, "in " + input.path + ": " + unknownName("DefineConstant", entry.first, known));
}

/// Gmsh makes edges somewhat longer than the requested size; beyond this factor the file prescribes the number of elements.
constexpr double kPrescribed = 3.0;

/// \throws InputError  edges far longer than the largest size
void checkLargest(const Mesh& mesh, const GmshInput& input) {
  if (input.largest <= 0) return;
  double longest = 0.0;
  int at = 0;
  for (int e = 0; e < mesh.elements(); ++e)
    for (const auto& edge : cellInfo(mesh.cells[e]).edges) {
      const Span<const int> nodes = mesh.nodesOf(e);
      const double length = norm(minus(mesh.point(nodes[edge[0]]), mesh.point(nodes[edge[1]])));
      if (length <= longest) continue;
      longest = length;
      at = e;
    }
  if (longest <= kPrescribed * input.largest * std::max(1.0, input.meshSizeFactor)) return;
  throw InputError("Mesh/Size", input.path + " has an element edge of length " + realText(longest) + " near " +
                                    placeText(centreOf(mesh, at), mesh.dimension) + " with Size " + realText(input.largest) +
                                    ": the file prescribes the number of elements there (Transfinite, Layers). Change it in the file, or "
                                    "remove Size");
}

std::string lengthText(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2g", length);
  return text;
}

/// Straightens tangled elements, and adds a note to the mesh.
void straighten(Mesh& mesh) {
  const Straightened found = straightenTangled(mesh);
  if (found.elements == 0) return;
  mesh.notes.push_back("curved sides of " + std::to_string(found.elements) + " of " + std::to_string(mesh.elements()) +
                       " elements would turn the elements inside out and are straighter than drawn: mid-side nodes lie up to " +
                       lengthText(found.distance) + " from the surface, at " + placeText(found.place, mesh.dimension) +
                       "; a smaller Mesh/Size keeps the shape");
}

/// The mesh of `order` from the cache, or from Gmsh. \param files  all files that Gmsh reads
GmshMesh cachedMesh(const GmshInput& input, const MesherOrder& order, const std::vector<std::string>& files) {
  const MeshCache cache(input.cache);
  const std::optional<std::string> key = cache.used() ? meshKey(order, input.constants, files) : std::nullopt;
  if (!key) return runMesher(order);
  if (std::optional<GmshMesh> found = cache.find(*key)) return std::move(*found);
  std::vector<FileStamp> programs;
  GmshMesh made = runMesher(order, &programs);
  if (meshKey(order, input.constants, files) == key) cache.store(*key, programs, made);  // no file has changed meanwhile
  return made;
}

Mesh finish(const GmshInput& input, const MesherOrder& order, const std::vector<std::string>& files, SideDescriptions* descriptions) {
  GmshMesh made = cachedMesh(input, order, files);
  if (descriptions) *descriptions = made.descriptions;
  swapFlatTriangles(made);
  Mesh mesh = assembleGmsh(std::move(made), input.path);
  if (!input.mayTangle) straighten(mesh);
  checkLargest(mesh, input);
  numberAlongHilbertCurve(mesh);
  return mesh;
}

MesherOrder orderOf(const GmshInput& input, const std::string& opened) {
  MesherOrder order;
  order.file = input.path;
  order.opened = opened;
  order.meshSizeFactor = input.meshSizeFactor;
  order.seconds = input.seconds;
  order.allowPrograms = input.allowPrograms;
  order.order = input.order;
  order.largest = input.largest;
  order.sizes = input.sizes;
  order.simplices = input.simplices;
  return order;
}

Mesh meshGeometry(const GmshInput& input) {
  Problems problems;
  std::vector<std::string> files;
  if (!input.allowPrograms) files = checkGeoStatements(input.path, problems);
  problems.throwIfAny();  // constants are looked up only if the statements are sound
  checkConstants(input, problems);
  problems.throwIfAny();
  const GeoWrapper wrapper(input.path, input.constants);
  return finish(input, orderOf(input, wrapper.path()), files, nullptr);
}

Mesh meshCad(const GmshInput& input, SideDescriptions* descriptions) {
  if (const std::string problem = cadFileProblem(input.path); !problem.empty()) throw InputError(kMeshFile, input.path + " " + problem);
  MesherOrder order = orderOf(input, input.path);
  order.allowPrograms = false;  // a CAD file holds no statements
  if (hasLengthUnit(cadFormat(input.path))) {
    const double millimetres = millimetresOf(input.unit);
    if (!(millimetres > 0))
      throw InputError("Mesh/Length Unit", "is unknown, and " + input.path +
                                               " carries its own unit; begin the scene's Units with mm, cm, m, um, in or ft "
                                               "(\"mm, N, MPa\"), or set Mesh/Length Unit to one of them");
    order.scale = 1 / millimetres;
  }
  return finish(input, order, {input.path}, descriptions);
}

}  // namespace

// A .msh file keeps the user's numbering; a mesh generated here may be renumbered.
Mesh readGmsh(const GmshInput& input, SideDescriptions* descriptions) {
  if (std::filesystem::path(input.path).extension() == ".geo") return meshGeometry(input);
  if (cadFormat(input.path) != CadFormat::None) return meshCad(input, descriptions);
  return assembleGmsh(readMsh(input.path), input.path);
}

double millimetresOf(const std::string& unit) {
  static const std::map<std::string, double> known{{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"um", 1e-3}, {"in", 25.4}, {"ft", 304.8}};
  const auto at = known.find(unit);
  return at == known.end() ? 0.0 : at->second;
}

}  // namespace suture
