#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Hdf5Mesh.hpp>
#include <suture/mesh/MeshReader.hpp>
#include <suture/mesh/gmsh/GmshReader.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace suture {

namespace {

namespace fs = std::filesystem;

Schema boxSchema() {
  return Schema("one box, a body of its own: surface group <name>, curve groups <name>_left, _right, _bottom, _top")
      .reals("X", std::vector<double>{0, 1}, "interval in x", "length")
      .reals("Y", std::vector<double>{0, 1}, "interval in y", "length")
      .integers("Cells", std::vector<int>{8, 8}, "cells in x and in y", Range::atLeast(1))
      .oneOf("Cell", "Triangle3", {"Triangle3", "Triangle6", "Quadrilateral4", "Quadrilateral8", "Quadrilateral9"},
             "shape of elements; triangles: each cell is cut in two, with alternating diagonals")
      .integers("Blocks", std::vector<int>{1, 1}, "surface groups subdomain_<name>_<i>_<j>: equal blocks of cells in x and in y",
                Range::atLeast(1))
      .integers("Bricks", std::nullopt,
                "a chess board of bricks of so many cells in x and in y, the last ones smaller if need be: surface groups "
                "<name>_bricks_even and <name>_bricks_odd, for the materials of Bodies/<name>/Regions; none if left out",
                Range::atLeast(1))
      .optional();
}

template <typename T>
std::pair<T, T> pairOf(const Parameters& list, const std::string& name, Problems& problems) {
  const auto& values = list.get<Teuchos::Array<T>>(name);
  if (values.size() == 2) return {values[0], values[1]};
  problems.add(pathOf(list, name), std::to_string(values.size()) + " values; expected two, for x and y");
  return {T(1), T(1)};
}

Mesh generateBoxes(const Parameters& list) {
  Problems problems;
  std::vector<Box> all;
  for (const std::string& name : sublistNames(list)) {
    const Parameters& own = list.sublist(name);
    Box box;
    box.name = name;
    std::tie(box.x0, box.x1) = pairOf<double>(own, "X", problems);
    std::tie(box.y0, box.y1) = pairOf<double>(own, "Y", problems);
    std::tie(box.nx, box.ny) = pairOf<int>(own, "Cells", problems);
    std::tie(box.blocksX, box.blocksY) = pairOf<int>(own, "Blocks", problems);
    if (own.isParameter("Bricks")) std::tie(box.brickX, box.brickY) = pairOf<int>(own, "Bricks", problems);
    const std::string cell = own.get<std::string>("Cell");
    for (int c = 0; c <= static_cast<int>(Cell::Quadrilateral9); ++c)
      if (cellInfo(static_cast<Cell>(c)).name == cell) box.cell = static_cast<Cell>(c);
    all.push_back(box);
  }
  if (all.empty()) problems.add(pathOf(list), "no boxes; expected a list for each, named as its body");
  problems.throwIfAny();
  return boxes(all);
}

std::map<std::string, double> constantsOf(const Parameters& mesh) {
  std::map<std::string, double> constants;
  if (!mesh.isSublist("Constants")) return constants;
  const Parameters& list = mesh.sublist("Constants");
  for (auto at = list.begin(); at != list.end(); ++at) constants[list.name(at)] = list.get<double>(list.name(at));
  return constants;
}

// Source of the mesh, checked the same way on all ranks: nothing here needs the file.
struct Source {
  std::string path, extension;  ///< file and its extension; empty: a generator
  std::map<std::string, double> constants;
  double factor = 1;
};

Source sourceOf(const Parameters& mesh, const std::string& folder) {
  Problems problems;
  Source source;
  const bool generated = mesh.get<std::string>("Generator") != "None";
  const bool file = mesh.isParameter("File");
  if (file == generated)
    problems.add(pathOf(mesh), file ? "both a File and a Generator; expected one of them" : "neither File nor Generator; expected one");
  if (file) {
    const fs::path name = mesh.get<std::string>("File");
    source.path = (name.is_absolute() ? name : fs::path(folder) / name).lexically_normal().string();
    source.extension = name.extension().string();
    const std::vector<std::string> known{".geo", ".msh", ".h5"};
    if (std::find(known.begin(), known.end(), source.extension) == known.end())
      problems.add(pathOf(mesh, "File"),
                   "'" + name.string() + "' ends with '" + source.extension + "'; expected one of " + joinNames(known));
  }
  source.constants = constantsOf(mesh);
  source.factor = mesh.get<double>("Mesh Size Factor");
  if (source.extension != ".geo") {
    const std::string why = "needs a .geo file: nothing else is meshed here";
    if (!source.constants.empty()) problems.add(pathOf(mesh, "Constants"), why);
    if (source.factor != 1) problems.add(pathOf(mesh, "Mesh Size Factor"), why);
  }
  problems.throwIfAny();
  return source;
}

}  // namespace

Schema meshSchema() {
  return Schema("where the mesh comes from: a File or a Generator")
      .text("File", std::nullopt, "mesh file, relative to the scene: .geo (meshed by Gmsh), .msh, or Suture's own .h5")
      .optional()
      .list("Constants",
            Schema("constants of a .geo file").eachReal("constant", "value instead of that of DefineConstant in the .geo file"))
      .boolean(
          "Allow Programs", false,
          "let a .geo file run programs (SystemCall), write files, read any other file and end Gmsh; false: such statements are refused")
      .real("Time Limit", 600.0,
            "seconds that Gmsh may take for a .geo file; a tenth of it for the statements of a .geo file before they are meshed",
            Range::positive(), "s")
      .real("Mesh Size Factor", 1.0, "multiplies all mesh sizes of a .geo file", Range::positive())
      .choice("Generator", "None",
              {{"None", Schema("the mesh is in File")},
               {"Boxes", Schema("boxes that share no nodes, in the order of the file").each("body", boxSchema())}},
              "makes the mesh instead of a File");
}

std::string meshFile(const Parameters& mesh, const std::string& folder) { return sourceOf(mesh, folder).path; }

Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder) {
  Source source;
  collectively(comm, "reading the scene's Mesh", [&] { source = sourceOf(mesh, folder); });
  if (source.extension == ".h5") return readHdf5Mesh(comm, source.path);

  Mesh made;
  collectivelyOnRoot(comm, "reading the mesh", [&] {
    if (source.path.empty()) {
      made = generateBoxes(mesh.sublist(mesh.get<std::string>("Generator")));
      return;
    }
    std::error_code failed;
    if (!fs::is_regular_file(source.path, failed)) throw InputError(pathOf(mesh, "File"), "there is no file " + source.path);
    made = readGmsh({source.path, source.constants, source.factor, mesh.get<double>("Time Limit"), mesh.get<bool>("Allow Programs")});
  });
  return made;
}

}  // namespace suture
