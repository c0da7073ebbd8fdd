// A checkpoint, for a mesh of one subdomain with four nodes. First byte even: the rest are the bytes of the file. Odd: numbers of a file
// that is valid HDF5, with right checksums and arbitrary content.
#include "Hdf5.hpp"

#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/report/Checkpoint.hpp>

#include <cmath>

using namespace suture;

namespace {

const char* const meshHash = "0123456789abcdef";

std::vector<SubdomainMesh> meshes() {
  SubdomainMesh mesh;
  mesh.id = mesh.body = 0;
  mesh.dimension = 2;
  mesh.coordinates = {0, 0, 1, 0, 1, 1, 0, 1};
  mesh.globalNodes = {0, 1, 2, 5};
  return {mesh};
}

void write(const std::string& path, fuzz::Bytes bytes) {
  Hdf5Writer file(fuzz::alone(), path);
  file.addChecksums();
  const std::string group = bytes.byte() % 16 == 15 ? "/Other" : "/SutureCheckpoint";
  file.group(group);
  if (const int kind = bytes.byte() % 16; kind < 15) file.attribute(group, "MeshHash", std::string(kind == 14 ? "another" : meshHash));
  std::vector<GlobalId> nodes;
  for (const int node : bytes.numbers()) nodes.push_back(node);
  std::vector<double> values(static_cast<std::size_t>(bytes.byte()));
  for (double& value : values) value = bytes.real();
  if (bytes.byte() % 16 != 15) file.write(group + "/Nodes", nodes);
  if (bytes.byte() % 16 != 15) file.write(group + "/Displacement", values, values.size() % 2 == 0 ? 2 : 1);
  if (bytes.byte() % 16 != 15) file.write(group + "/Pairs", bytes.numbers());
  if (bytes.byte() % 16 != 15) file.write(group + "/Status", bytes.numbers());
  file.close();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::beginAlone();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  static const std::vector<SubdomainMesh> mine = meshes();
  if (size == 0) return 0;
  const std::string path = folder.path() + "/checkpoint.h5";
  if (data[0] % 2 == 0)
    folder.file("checkpoint.h5", data + 1, size - 1);
  else
    write(path, {data + 1, size - 1});
  fuzz::accepts([&] {
    const Start start = readCheckpoint(fuzz::alone(), path, meshHash, mine);
    fuzz::require(start.displacement.size() == 1 && start.displacement[0].size() == 8 && start.displacement[0].allFinite());
  });
  return 0;
}
