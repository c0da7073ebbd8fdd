#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/reader/Hdf5Mesh.hpp>
#include <suture/reader/MeshArrays.hpp>

#include <Teuchos_Comm.hpp>

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

/// Reads one file.
class Reader {
 public:
  Reader(const Comm& alone, const std::string& path) : path_(path), file_(alone, path) {}

  Mesh read() {
    checkVersion();
    MeshArrays arrays;
    arrays.dimension = file_.readInts("/Dimension");
    arrays.coordinates = file_.readReals("/Coordinates");
    arrays.cells = file_.readInts("/Cells");
    arrays.offsets = file_.readInts("/Offsets");
    arrays.connectivity = file_.readInts("/Connectivity");
    readGroups("/ElementGroups", arrays.elementGroups);
    readGroups("/SideGroups", arrays.sideGroups);
    return meshFromArrays(std::move(arrays), "Mesh/File", path_);
  }

 private:
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

  void readGroups(const std::string& folder, std::vector<MeshArrays::Group>& groups) {
    if (!file_.has(folder)) throw InputError("Mesh/File", path_ + ": " + folder + ": is missing");
    for (const std::string& member : file_.members(folder)) {
      const std::string dataset = folder + "/" + member;
      groups.push_back({dataset, file_.readTextAttribute(dataset, "Name"), file_.readInts(dataset)});
    }
  }

  std::string path_;
  Hdf5Reader file_;
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
