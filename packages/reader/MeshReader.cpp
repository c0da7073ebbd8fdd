#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/reader/Hdf5Mesh.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/cad/SideDescriptions.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>
#include <suture/reader/gmsh/MeshCache.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace suture {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> cellNames() {
  std::vector<std::string> names;
  for (int cell = 0; cell < kCells; ++cell) names.push_back(cellInfo(static_cast<Cell>(cell)).name);
  return names;
}

Schema boxSchema() {
  return Schema(
             "one box, which is one body: element group <name>, side groups <name>_left, _right (in x), _bottom, _top (in y; in 3D in z), "
             "in "
             "3D also _front, _back (in y). Arrays have two values in 2D and three in 3D")
      .reals("X", std::vector<double>{0, 1}, "interval in x", "length")
      .reals("Y", std::vector<double>{0, 1}, "interval in y", "length")
      .reals("Z", std::vector<double>{0, 1}, "interval in z, for 3D cells only", "length")
      .integers("Cells", std::nullopt, "number of cells in x and y, in 3D also in z; eight each by default", Range::atLeast(1))
      .optional()
      .oneOf("Cell", "Triangle3", cellNames(),
             "element shape. Triangles: each cell is cut into two, with alternating diagonals; tetrahedra: into six; wedges: into two; "
             "pyramids: into six; other shapes: cells are not cut")
      .integers("Blocks", std::nullopt,
                "element groups subdomain_<name>_<i>_<j>, in 3D also _<k>: equal blocks of cells in each direction; one by default",
                Range::atLeast(1))
      .optional()
      .integers("Bricks", std::nullopt,
                "checkerboard of bricks with this many cells in each direction, the last ones smaller if necessary: element groups "
                "<name>_bricks_even and <name>_bricks_odd, for the materials of Bodies/<name>/Regions; none by default",
                Range::atLeast(1))
      .optional();
}

/// Reads a list with one value per direction. \param values  destinations; unchanged where the list is absent
template <typename T>
void readEach(const Parameters& list, const std::string& name, const std::vector<T*>& values, const char* directions, Problems& problems) {
  if (!list.isParameter(name)) return;
  const auto& given = list.get<Teuchos::Array<T>>(name);
  if (given.size() == static_cast<int>(values.size())) {
    for (std::size_t k = 0; k < values.size(); ++k) *values[k] = given[static_cast<int>(k)];
    return;
  }
  problems.add(pathOf(list, name), std::to_string(given.size()) + " values; expected " + directions);
}

Mesh generateBoxes(const Parameters& list) {
  Problems problems;
  std::vector<Box> all;
  for (const std::string& name : sublistNames(list)) {
    const Parameters& own = list.sublist(name);
    Box box;
    box.name = name;
    const std::string cell = own.get<std::string>("Cell");
    for (int c = 0; c < kCells; ++c)
      if (cellInfo(static_cast<Cell>(c)).name == cell) box.cell = static_cast<Cell>(c);
    const bool inSpace = dimensionOf(box.cell) == 3;
    const auto each = [inSpace](auto& x, auto& y, auto& z) {
      std::vector values{&x, &y};
      if (inSpace) values.push_back(&z);
      return values;
    };
    const char* const directions = inSpace ? "three, for x, y and z" : "two, for x and y";
    readEach<double>(own, "X", {&box.x0, &box.x1}, "two, its ends", problems);
    readEach<double>(own, "Y", {&box.y0, &box.y1}, "two, its ends", problems);
    readEach<double>(own, "Z", {&box.z0, &box.z1}, "two, its ends", problems);
    readEach<int>(own, "Cells", each(box.nx, box.ny, box.nz), directions, problems);
    readEach<int>(own, "Blocks", each(box.blocksX, box.blocksY, box.blocksZ), directions, problems);
    readEach<int>(own, "Bricks", each(box.brickX, box.brickY, box.brickZ), directions, problems);
    all.push_back(box);
  }
  if (all.empty()) problems.add(pathOf(list), "no boxes; expected one list per box, named after its body");
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

// Source of the mesh, checked identically on all ranks; the check does not need the file.
struct Source {
  std::string path, extension;  ///< file and its extension; empty: a generator
  CadFormat cad = CadFormat::None;
  std::map<std::string, double> constants;
  double factor = 1, largest = 0;
  int order = 0;
  std::string unit;
};

const char* const kNoUnit = "unknown";

std::vector<std::string> lengthUnits() { return {"mm", "cm", "m", "um", "in", "ft", kNoUnit}; }

/// Unit of length in the scene's Units, "mm, N, MPa".
std::string unitOfScene(const Parameters& scene) {
  if (!scene.isType<std::string>("Units")) return kNoUnit;
  const std::string& names = scene.get<std::string>("Units");
  const std::string first = trimmed(names.substr(0, names.find(',')));
  return millimetresOf(first) > 0 ? first : kNoUnit;
}

/// Parameters that only some kinds of files can obey.
void checkApplies(const Parameters& mesh, const Source& source, Problems& problems) {
  const bool geo = source.extension == ".geo", meshed = geo || source.cad != CadFormat::None;
  const std::string found = source.path.empty() ? "a Generator" : "a " + source.extension + " file";
  const auto refuse = [&](bool given, bool applies, const std::string& name, const std::string& why) {
    if (given && !applies) problems.add(pathOf(mesh, name), why);
  };
  refuse(!source.constants.empty(), geo, "Constants", "needs a .geo file, found " + found);
  const std::string meshesOnly = "needs a file that Gmsh meshes (.geo, " + joinNames(cadEndings()) + "), found " + found;
  const std::string generator = source.path.empty() ? ": set Cell and Cells of its boxes" : ", which is a mesh already";
  refuse(source.factor != 1, meshed, "Mesh Size Factor", meshesOnly + generator);
  refuse(source.largest > 0, meshed, "Size", meshesOnly + generator);
  refuse(source.order > 0, meshed, "Order", meshesOnly + generator);
}

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
    source.cad = cadFormat(source.path);
    std::vector<std::string> known{".geo", ".msh", ".h5"};
    known.insert(known.end(), cadEndings().begin(), cadEndings().end());
    if (source.cad == CadFormat::None && std::find(known.begin(), known.end(), source.extension) == known.end())
      problems.add(pathOf(mesh, "File"),
                   "'" + name.string() + "' ends with '" + source.extension + "'; expected one of " + joinNames(known));
  }
  source.constants = constantsOf(mesh);
  source.factor = mesh.get<double>("Mesh Size Factor");
  if (mesh.isParameter("Size")) source.largest = mesh.get<double>("Size");
  if (mesh.isParameter("Order")) source.order = mesh.get<int>("Order");
  source.unit = mesh.get<std::string>("Length Unit");
  checkApplies(mesh, source, problems);
  problems.throwIfAny();
  return source;
}

}  // namespace

Schema meshSchema() {
  return Schema("source of the mesh: a File or a Generator")
      .text("File", std::nullopt,
            "file, relative to the scene: a geometry that Gmsh meshes (.geo, or CAD: .step, .stp, .iges, .igs, .brep, .stl), a mesh "
            "(.msh), or "
            "Suture's own .h5")
      .optional()
      .list("Constants",
            Schema("constants of a .geo file").eachReal("constant", "value that replaces that of DefineConstant in the .geo file"))
      .boolean(
          "Allow Programs", false,
          "permit a .geo file to run programs (SystemCall), write files, read any file and end Gmsh; false: such statements are refused")
      .real("Time Limit", 600.0,
            "time limit of Gmsh for a .geo or CAD file; the statements of a .geo file, read before it is meshed, may take a tenth of it",
            Range::positive(), "s")
      .boolean(
          "Cache", true,
          "keep the mesh of a .geo or CAD file for later runs of the same geometry, in the folder SUTURE_MESH_CACHE of the environment "
          "(off: no folder), by default ~/.cache/suture/meshes; at most 512 MB")
      .real("Mesh Size Factor", 1.0, "multiplies all mesh sizes of a .geo or CAD file", Range::positive())
      .real(
          "Size", std::nullopt,
          "largest size of elements of a .geo or CAD file (multiplied by Mesh Size Factor); by default as the .geo file says, for CAD from "
          "curvature and thickness",
          Range::positive(), "length")
      .optional()
      .integer("Order", std::nullopt, "order of the elements of a .geo or CAD file: 1 or 2; by default as the .geo file says, 2 for CAD",
               Range{1, 2, false, false, {}})
      .optional()
      .oneOf(
          "Length Unit", kNoUnit, lengthUnits(),
          "unit of length of the mesh of a STEP or IGES file, which is converted to it; by default the first of the scene's Units. Other "
          "files have no units, and their numbers are taken as they are")
      .fittingDefault(unitOfScene)
      .choice("Generator", "None",
              {{"None", Schema("the mesh is in File")},
               {kGivenMesh, Schema("the program that uses the library gives the mesh: arrays in Python")},
               {"Boxes", Schema("boxes that share no nodes, in the order of the scene file").each("body", boxSchema())}},
              "generates the mesh, in place of a File");
}

std::string meshFile(const Parameters& mesh, const std::string& folder) { return sourceOf(mesh, folder).path; }

Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder) {
  SideDescriptions unused;
  return readMesh(comm, mesh, folder, unused);
}

namespace {

Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder, const MeshChanges& changes,
              SideDescriptions& descriptions) {
  Source source;
  collectively(comm, "reading the scene's Mesh", [&] { source = sourceOf(mesh, folder); });
  if (source.extension == ".h5") return readHdf5Mesh(comm, source.path);

  Mesh made;
  collectivelyOnRoot(comm, "reading the mesh", [&] {
    if (source.path.empty()) {
      if (mesh.get<std::string>("Generator") == kGivenMesh)
        throw InputError(pathOf(mesh, "Generator"), std::string(kGivenMesh) + ", but no program gave a mesh; expected a File or Boxes");
      made = generateBoxes(mesh.sublist(mesh.get<std::string>("Generator")));
      return;
    }
    std::error_code failed;
    if (!fs::is_regular_file(source.path, failed)) throw InputError(pathOf(mesh, "File"), "there is no file " + source.path);
    GmshInput input;
    input.path = source.path;
    input.constants = source.constants;
    input.meshSizeFactor = source.factor * changes.factor;
    input.seconds = mesh.get<double>("Time Limit");
    input.allowPrograms = mesh.get<bool>("Allow Programs");
    input.order = source.order == 0 ? changes.order : source.order;
    input.simplices = changes.simplices;
    input.mayTangle = changes.mayTangle;
    input.sizes = changes.sizes;
    input.largest = source.largest;
    input.unit = source.unit;
    if (mesh.get<bool>("Cache")) input.cache = meshCacheFolder();
    made = readGmsh(input, &descriptions);
  });
  return made;
}

}  // namespace

Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder, SideDescriptions& descriptions) {
  return readMesh(comm, mesh, folder, MeshChanges{}, descriptions);
}

Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder, const MeshChanges& changes) {
  SideDescriptions unused;
  return readMesh(comm, mesh, folder, changes, unused);
}

bool isGeometry(const Parameters& mesh, const std::string& folder) {
  const Source source = sourceOf(mesh, folder);
  return source.extension == ".geo" || source.cad != CadFormat::None;
}

}  // namespace suture
