// A mesh file of Suture. First byte even: the rest are the bytes of the file. Odd: numbers of a file that is valid HDF5, with right
// checksums and arbitrary content.
#include "Hdf5.hpp"

#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/reader/Hdf5Mesh.hpp>

using namespace suture;

namespace {

void write(const std::string& path, fuzz::Bytes bytes) {
  Hdf5Writer file(fuzz::alone(), path);
  file.addChecksums();
  file.attribute("/", "SutureMesh", std::string(bytes.byte() % 16 == 15 ? "2" : "1"));
  const int dimension = bytes.byte() % 16;
  file.write("/Dimension", std::vector<int>{dimension == 15 ? bytes.number() : dimension > 10 ? 3 : 2});
  std::vector<double> places(static_cast<std::size_t>(bytes.byte()));
  for (double& x : places) x = bytes.real();
  file.write("/Coordinates", places);
  // Valid offsets half of the time: otherwise nothing behind them is ever read.
  const std::vector<int> cells = bytes.numbers(), connectivity = bytes.numbers();
  std::vector<int> offsets{0};
  if (bytes.byte() % 2 == 0)
    for (const int cell : cells)
      offsets.push_back(offsets.back() + (cell >= 0 && cell < kCells ? cellInfo(static_cast<Cell>(cell)).nodes : 9));
  else
    offsets = bytes.numbers();
  file.write("/Cells", cells);
  file.write("/Offsets", offsets);
  file.write("/Connectivity", connectivity);
  for (const std::string folder : {"/ElementGroups", "/SideGroups"}) {
    const int groups = bytes.byte() % 4;
    if (groups == 3) continue;
    file.group(folder);
    for (int k = 0; k < groups; ++k) {
      const std::string member = folder + "/" + std::to_string(k);
      file.write(member, bytes.numbers());
      if (bytes.byte() % 16 != 15) file.attribute(member, "Name", bytes.name());
    }
  }
  file.close();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::beginAlone();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  if (size == 0) return 0;
  std::string path = folder.path() + "/mesh.h5";
  if (data[0] % 2 == 0)
    folder.file("mesh.h5", data + 1, size - 1);
  else
    write(path, {data + 1, size - 1});
  fuzz::accepts([&] {
    Mesh mesh = readHdf5Mesh(fuzz::alone(), path);
    mesh.hash();
    assignBodies(mesh, mesh.elementGroupNames());
    makeAxisymmetric(mesh);
  });
  return 0;
}
