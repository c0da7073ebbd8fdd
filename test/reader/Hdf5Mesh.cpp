#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/reader/Hdf5Mesh.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

#include <mesh/ReferenceCells.hpp>
#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;
using meshtesting::world;

namespace {

// Two bodies of different cells, with coordinates that no decimal form would preserve; on rank 0.
Mesh sample() {
  Mesh mesh;
  if (world()->getRank() != 0) return mesh;
  Box lower, upper;
  lower.name = "lower / 1";
  lower.cell = Cell::Triangle6;
  lower.nx = 3, lower.ny = 2;
  upper.name = "upper";
  upper.cell = Cell::Quadrilateral8;
  upper.y0 = 1, upper.y1 = 2;
  upper.nx = upper.ny = 2;
  mesh = boxes({lower, upper});
  for (double& x : mesh.coordinates) x = x / 3 + 1e-17;
  mesh.elementGroups["empty"];
  return mesh;
}

/// A box meshed with each 3D cell.
Mesh sampleInSpace() {
  Mesh mesh;
  if (world()->getRank() != 0) return mesh;
  std::vector<Box> all;
  for (const Cell cell : referencecells::solid) {
    Box box;
    box.name = cellInfo(cell).name;
    box.cell = cell;
    box.x0 = 2.0 * static_cast<int>(cell), box.x1 = box.x0 + 1;
    box.nx = 2, box.ny = box.nz = 1;
    all.push_back(box);
  }
  mesh = boxes(all);
  for (double& x : mesh.coordinates) x = x / 3 + 1e-17;
  return mesh;
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Message of the reader for a valid mesh after `change` has modified it.
std::string saidAbout(const std::function<void(Mesh&)>& change) {
  const Folder folder;
  Mesh mesh = sample();
  if (world()->getRank() == 0) change(mesh);
  const std::string path = folder.path() + "/m.h5";
  writeHdf5Mesh(*world(), mesh, path);
  const std::string said = problemsOf([&] { readHdf5Mesh(*world(), path); });
  return meshtesting::sameEverywhere(said) ? said : "different messages";
}

}  // namespace

TEUCHOS_UNIT_TEST(Hdf5Mesh, GivesEveryBitBack) {
  const Folder folder;
  for (const Mesh& mesh : {sample(), sampleInSpace()}) {
    const std::string path = folder.path() + "/m.h5";
    writeHdf5Mesh(*world(), mesh, path);
    const Mesh back = readHdf5Mesh(*world(), path);
    TEST_EQUALITY(back.dimension, mesh.dimension);
    TEST_ASSERT(sameBits(back.coordinates, mesh.coordinates));
    TEST_ASSERT(sameBits(back.cells, mesh.cells));
    TEST_ASSERT(sameBits(back.offsets, mesh.offsets));
    TEST_ASSERT(sameBits(back.connectivity, mesh.connectivity));
    TEST_ASSERT(back.elementGroups == mesh.elementGroups);
    TEST_EQUALITY(back.sideGroups.size(), mesh.sideGroups.size());
    for (const auto& [name, sides] : mesh.sideGroups) TEST_ASSERT(sameBits(back.sideGroups.at(name), sides));
    TEST_EQUALITY(back.hash(), mesh.hash());
    TEST_EQUALITY(back.elements() > 0, world()->getRank() == 0);
  }
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, ReadsAsAMeshOfTheScene) {
  const Folder folder;
  const Mesh mesh = sample();
  writeHdf5Mesh(*world(), mesh, folder.path() + "/m.h5");
  TEST_EQUALITY(meshtesting::read(meshtesting::fileParameter("m.h5"), folder.path()).hash(), mesh.hash());
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, RefusesNumbersOutOfRange) {
  const std::string node = saidAbout([](Mesh& mesh) { mesh.connectivity[3] = 4711; });
  SUTURE_CHECK_SAYS(node, "/Connectivity: node 4711; there are");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.connectivity[3] = -1; }), "/Connectivity: node -1; there are");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.cells[1] = static_cast<Cell>(12); }),
                    "/Cells: element 1 has the unknown shape 12; expected 0 to 11");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.cells[1] = Cell::Wedge6; }),
                    "/Cells: element 1 is a Wedge6; expected a shape of dimension 2, as in /Dimension");
  const auto inSpace = [](Mesh& mesh) {
    mesh.dimension = 3;
    mesh.coordinates.resize(mesh.coordinates.size() / 2 * 3);
  };
  SUTURE_CHECK_SAYS(saidAbout(inSpace), "/Cells: element 0 is a Triangle6; expected a shape of dimension 3");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.dimension = 4; }), "/Dimension: expected 2 or 3");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.elementGroups["upper"][0] = 999; }), "element 999; there are 16");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.sideGroups["upper_top"][0].side = 4; }), "side 4 of element");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.coordinates[2] = std::numeric_limits<double>::quiet_NaN(); }),
                    "/Coordinates: the coordinates of node 1 are not finite");
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, RefusesSizesThatContradictEachOther) {
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.offsets.pop_back(); }), "/Offsets: 16 values for 16 elements");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.connectivity.pop_back(); }), "/Offsets: 17 values for 16 elements");
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) { mesh.offsets[1] += 1; }), "/Offsets: element 0 (Triangle6) has 7 nodes");
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, RefusesSidesInsideTheMaterial) {
  SUTURE_CHECK_SAYS(saidAbout([](Mesh& mesh) {
                      // each side of the box' middle element except its lower one is interior
                      mesh.sideGroups["upper_top"][0].side = 1;
                    }),
                    "group 'upper_top': side 1 of element");
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, RefusesForeignAndDamagedFiles) {
  const Folder folder;
  const auto said = [&](const std::string& path) {
    const std::string text = problemsOf([&] { readHdf5Mesh(*world(), path); });
    return meshtesting::sameEverywhere(text) ? text : "different messages";
  };
  SUTURE_CHECK_SAYS(said(folder.path() + "/none.h5"), "none.h5");
  SUTURE_CHECK_SAYS(said(folder.write("text.h5", "no HDF5 at all\n")), "text.h5");

  const std::string foreign = folder.path() + "/foreign.h5";
  Hdf5Writer file(*world(), foreign);
  file.write("/Coordinates", std::vector<double>{});
  file.close();
  SUTURE_CHECK_SAYS(said(foreign), "is an HDF5 file, but not a Suture mesh");

  const std::string later = folder.path() + "/later.h5";
  Hdf5Writer newer(*world(), later);
  newer.attribute("/", "SutureMesh", std::string("2"));
  newer.close();
  SUTURE_CHECK_SAYS(said(later), "is a mesh of version 2; this Suture reads version 1 only");

  const std::string bare = folder.path() + "/bare.h5";
  Hdf5Writer incomplete(*world(), bare);
  incomplete.attribute("/", "SutureMesh", std::string("1"));
  incomplete.close();
  SUTURE_CHECK_SAYS(said(bare), "/Dimension");

  const std::string cut = folder.path() + "/cut.h5";
  writeHdf5Mesh(*world(), sample(), cut);
  if (world()->getRank() == 0) std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  world()->barrier();
  SUTURE_CHECK_SAYS(said(cut), "cut.h5");
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, RefusesAChangedBit) {
  const Folder folder;
  const std::string path = folder.path() + "/m.h5";
  const Mesh mesh = sample();
  writeHdf5Mesh(*world(), mesh, path);
  if (world()->getRank() == 0) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(mesh.coordinates.data()), 8 * mesh.coordinates.size()));
    TEST_ASSERT(at != std::string::npos);
    file.clear();
    file.seekp(static_cast<std::streamoff>(at + 40));
    file.put('\x01');
  }
  world()->barrier();
  const std::string said = problemsOf([&] { readHdf5Mesh(*world(), path); });
  SUTURE_CHECK_SAYS(said, "cannot read '/Coordinates': it is damaged: its values do not have the checksum");
  TEST_ASSERT(meshtesting::sameEverywhere(said));
}

TEUCHOS_UNIT_TEST(Hdf5Mesh, ReportsAFolderThatCannotBeWritten) {
  TEST_THROW(writeHdf5Mesh(*world(), sample(), "/no/such/folder/m.h5"), EnvironmentError);
}
