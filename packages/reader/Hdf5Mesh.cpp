#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/reader/Hdf5Mesh.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

const char* const versionName = "SutureMesh";
const char* const versionNumber = "1";

// Communicator of rank 0 alone, the only rank with a mesh. The other ranks get null.
Teuchos::RCP<Comm> rootAlone(const Comm& comm) { return comm.split(comm.getRank() == 0 ? 0 : -1, 0); }

// Group names are arbitrary, dataset names are not: groups are numbered and carry their names as attributes.
std::string memberPath(const std::string& group, std::size_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "/%06zu", number);
  return group + text;
}

void writeFile(const Comm& alone, const Mesh& mesh, const std::string& path, const std::function<void(Hdf5Writer&)>& more) {
  Hdf5Writer file(alone, path);
  file.addChecksums();
  file.attribute("/", versionName, std::string(versionNumber));
  std::vector<int> cells;
  for (const Cell cell : mesh.cells) cells.push_back(static_cast<int>(cell));
  file.write("/Dimension", std::vector<int>{mesh.dimension});
  file.write("/Coordinates", mesh.coordinates, mesh.dimension);
  file.write("/Cells", cells);
  file.write("/Offsets", mesh.offsets);
  file.write("/Connectivity", mesh.connectivity);

  file.group("/ElementGroups");
  std::size_t number = 0;
  for (const auto& [name, elements] : mesh.elementGroups) {
    const std::string member = memberPath("/ElementGroups", number++);
    file.write(member, elements);
    file.attribute(member, "Name", name);
  }
  file.group("/SideGroups");
  number = 0;
  for (const auto& [name, sides] : mesh.sideGroups) {
    const std::string member = memberPath("/SideGroups", number++);
    std::vector<int> flat;
    for (const Side& side : sides) flat.insert(flat.end(), {side.element, side.side});
    file.write(member, flat, 2);
    file.attribute(member, "Name", name);
  }
  if (more) more(file);
  file.close();
}

/// Reads one file and collects all errors in `problems`.
class Reader {
 public:
  Reader(const Comm& alone, const std::string& path) : path_(path), file_(alone, path) {}

  Mesh read() {
    checkVersion();
    readBlock();
    problems_.throwIfAny();  // groups refer to elements: check groups only if the elements are sound
    readElementGroups();
    readSideGroups();
    problems_.throwIfAny();
    return std::move(mesh_);
  }

 private:
  void wrong(const std::string& dataset, const std::string& what) { problems_.add("Mesh/File", path_ + ": " + dataset + ": " + what); }

  void checkVersion() {
    std::string version;
    try {
      version = file_.readTextAttribute("/", versionName);
    } catch (const InputError&) {
      throw InputError("Mesh/File", path_ + ": is an HDF5 file, but not a Suture mesh (it lacks the attribute " + versionName + ")");
    }
    if (version != versionNumber)
      throw InputError("Mesh/File", path_ + ": is a mesh of version " + version + "; this Suture reads version " + versionNumber + " only");
  }

  void readBlock() {
    mesh_.source = path_;
    const std::vector<int> dimension = file_.readInts("/Dimension");
    mesh_.coordinates = file_.readReals("/Coordinates");
    const std::vector<int> cells = file_.readInts("/Cells");
    mesh_.offsets = file_.readInts("/Offsets");
    mesh_.connectivity = file_.readInts("/Connectivity");

    if (dimension.size() != 1 || (dimension[0] != 2 && dimension[0] != 3)) {
      wrong("/Dimension", "expected 2 or 3");
      return;
    }
    mesh_.dimension = dimension[0];
    const auto width = static_cast<std::size_t>(mesh_.dimension);
    if (mesh_.coordinates.size() % width != 0)
      wrong("/Coordinates", std::to_string(mesh_.coordinates.size()) + " values; expected " + std::to_string(width) + " per node");
    for (std::size_t i = 0; i < mesh_.coordinates.size(); ++i) {
      if (std::isfinite(mesh_.coordinates[i])) continue;
      wrong("/Coordinates", "the coordinates of node " + std::to_string(i / width) + " are not finite");
      break;
    }
    if (cells.empty()) wrong("/Cells", "no elements");
    if (mesh_.offsets.size() != cells.size() + 1 || mesh_.offsets[0] != 0 ||
        mesh_.offsets.back() != static_cast<int>(mesh_.connectivity.size())) {
      wrong("/Offsets", std::to_string(mesh_.offsets.size()) + " values for " + std::to_string(cells.size()) + " elements with " +
                            std::to_string(mesh_.connectivity.size()) + " nodes in /Connectivity; expected " +
                            std::to_string(cells.size() + 1) + " values from 0 to " + std::to_string(mesh_.connectivity.size()));
      return;
    }
    mesh_.cells.reserve(cells.size());
    for (std::size_t e = 0; e < cells.size(); ++e) {
      if (cells[e] < 0 || cells[e] >= kCells) {
        wrong("/Cells", "element " + std::to_string(e) + " has the unknown shape " + std::to_string(cells[e]) + "; expected 0 to " +
                            std::to_string(kCells - 1));
        return;
      }
      const Cell cell = static_cast<Cell>(cells[e]);
      if (dimensionOf(cell) != mesh_.dimension) {
        wrong("/Cells", "element " + std::to_string(e) + " is a " + cellInfo(cell).name + "; expected a shape of dimension " +
                            std::to_string(mesh_.dimension) + ", as in /Dimension");
        return;
      }
      const int nodes = mesh_.offsets[e + 1] - mesh_.offsets[e];
      if (nodes != cellInfo(cell).nodes) {
        wrong("/Offsets", "element " + std::to_string(e) + " (" + cellInfo(cell).name + ") has " + std::to_string(nodes) + " nodes");
        return;
      }
      mesh_.cells.push_back(cell);
    }
    checkNumbers("/Connectivity", mesh_.connectivity, 1, 0, mesh_.nodes(), "node");
  }

  // Checks that the entries at `offset`, `offset + stride`, ... lie in 0 .. limit - 1.
  bool checkNumbers(const std::string& dataset, const std::vector<int>& values, std::size_t stride, std::size_t offset, int limit,
                    const std::string& what) {
    for (std::size_t i = offset; i < values.size(); i += stride) {
      if (values[i] >= 0 && values[i] < limit) continue;
      wrong(dataset, what + " " + std::to_string(values[i]) + "; there are " + std::to_string(limit) + ", counted from 0");
      return false;
    }
    return true;
  }

  template <typename Group>
  void readGroups(const std::string& folder, Group take) {
    if (!file_.has(folder)) {
      wrong(folder, "is missing");
      return;
    }
    for (const std::string& member : file_.members(folder)) {
      const std::string dataset = folder + "/" + member;
      take(dataset, file_.readTextAttribute(dataset, "Name"), file_.readInts(dataset));
    }
  }

  void readElementGroups() {
    readGroups("/ElementGroups", [&](const std::string& dataset, const std::string& name, std::vector<int> elements) {
      checkNumbers(dataset, elements, 1, 0, mesh_.elements(), "element");
      if (!mesh_.elementGroups.emplace(name, std::move(elements)).second) wrong(dataset, "a second group named '" + name + "'");
    });
  }

  void readSideGroups() {
    std::map<std::string, std::string> datasetOf;  // by the group's name
    std::vector<Side> all;
    readGroups("/SideGroups", [&](const std::string& dataset, const std::string& name, const std::vector<int>& flat) {
      if (flat.size() % 2 != 0) {
        wrong(dataset, "an odd number of values for (element, side)");
        return;
      }
      if (!checkNumbers(dataset, flat, 2, 0, mesh_.elements(), "element")) return;
      std::vector<Side> sides;
      for (std::size_t i = 0; i < flat.size(); i += 2) {
        const Side side{flat[i], flat[i + 1]};
        const int count = static_cast<int>(cellInfo(mesh_.cells[side.element]).sideNodes.size());
        if (side.side < 0 || side.side >= count) {
          wrong(dataset, "side " + std::to_string(side.side) + " of element " + std::to_string(side.element) + ", which has " +
                             std::to_string(count));
          return;
        }
        sides.push_back(side);
      }
      all.insert(all.end(), sides.begin(), sides.end());
      if (mesh_.sideGroups.emplace(name, std::move(sides)).second)
        datasetOf[name] = dataset;
      else
        wrong(dataset, "a second group named '" + name + "'");
    });
    const SideTable table(mesh_, all);
    for (const auto& [name, sides] : mesh_.sideGroups) {
      const auto inside = std::find_if(sides.begin(), sides.end(), [&](const Side& side) { return !table.onBoundary(side); });
      if (inside != sides.end())
        wrong(datasetOf.at(name), "group '" + name + "': side " + std::to_string(inside->side) + " of element " +
                                      std::to_string(inside->element) + " at " +
                                      placeText(centreOf(mesh_, inside->element), mesh_.dimension) + " lies inside the material");
    }
  }

  std::string path_;
  Hdf5Reader file_;
  Mesh mesh_;
  Problems problems_;
};

}  // namespace

void writeHdf5Mesh(const Comm& comm, const Mesh& mesh, const std::string& path, const std::function<void(Hdf5Writer&)>& more) {
  const auto alone = rootAlone(comm);
  collectivelyOnRoot(comm, "writing the mesh " + path, [&] { writeFile(*alone, mesh, path, more); });
}

Mesh readHdf5Mesh(const Comm& comm, const std::string& path) {
  const auto alone = rootAlone(comm);
  Mesh mesh;
  collectivelyOnRoot(comm, "reading the mesh " + path, [&] { mesh = Reader(*alone, path).read(); });
  return mesh;
}

}  // namespace suture
