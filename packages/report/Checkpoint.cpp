#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Hdf5File.hpp>
#include <suture/report/Checkpoint.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr const char* kGroup = "/SutureCheckpoint";
std::string at(const char* name) { return std::string(kGroup) + "/" + name; }
}  // namespace

void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution) {
  int dimension = 1;
  const int mine = meshes.empty() ? 1 : meshes.front().dimension;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(dimension));
  std::vector<GlobalId> nodes;
  std::vector<double> values;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    nodes.insert(nodes.end(), meshes[s].globalNodes.begin(), meshes[s].globalNodes.end());
    values.insert(values.end(), solution.displacement[s].data(), solution.displacement[s].data() + solution.displacement[s].size());
  }
  std::vector<int> pairs, status;
  for (const PairResult& pair : solution.pairs) {
    pairs.push_back(pair.id);
    status.push_back(static_cast<int>(pair.status));
  }
  Hdf5File file = Hdf5File::create(comm, path);
  file.addChecksums();
  file.group(kGroup);
  file.attribute(kGroup, "MeshHash", broadcast(comm, meshHash));
  file.write(at("Nodes"), nodes);
  file.write(at("Displacement"), values, dimension);
  file.write(at("Pairs"), pairs);
  file.write(at("Status"), status);
  file.close();
}

Checkpoint readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash,
                          const std::vector<SubdomainMesh>& meshes) {
  const Hdf5File file = Hdf5File::open(comm, path);
  if (!file.has(kGroup)) throw InputError(path, "not a checkpoint of Suture: it has no group " + std::string(kGroup));
  const std::string expected = broadcast(comm, meshHash), found = file.readTextAttribute(kGroup, "MeshHash");
  if (found != expected) throw InputError(path, "a checkpoint of another mesh (hash " + found + ", this mesh has " + expected + ")");
  const std::vector<GlobalId> nodes = file.readGlobalIds(at("Nodes"));
  const std::vector<double> values = file.readReals(at("Displacement"));
  const std::vector<int> pairs = file.readInts(at("Pairs")), status = file.readInts(at("Status"));

  Checkpoint checkpoint;
  collectively(comm, "reading a checkpoint", [&] {
    std::map<GlobalId, std::size_t> rowOf;
    for (std::size_t i = 0; i < nodes.size(); ++i) rowOf.emplace(nodes[i], i);
    for (const SubdomainMesh& mesh : meshes) {
      const auto d = static_cast<std::size_t>(mesh.dimension);
      Vector displacement(mesh.nodes() * mesh.dimension);
      for (int node = 0; node < mesh.nodes(); ++node) {
        const auto row = rowOf.find(mesh.globalNodes[node]);
        if (row == rowOf.end() || (row->second + 1) * d > values.size())
          throw InputError(path, "damaged: no displacement of node " + std::to_string(mesh.globalNodes[node]));
        for (std::size_t k = 0; k < d; ++k)
          if (!std::isfinite(values[row->second * d + k]))
            throw InputError(path, "damaged: the displacement of node " + std::to_string(mesh.globalNodes[node]) + " is not finite");
        for (std::size_t k = 0; k < d; ++k) displacement(static_cast<Eigen::Index>(node * d + k)) = values[row->second * d + k];
      }
      checkpoint.displacement.push_back(std::move(displacement));
    }
    if (pairs.size() != status.size())
      throw InputError(path, "damaged: " + std::to_string(pairs.size()) + " pairs, " + std::to_string(status.size()) + " states");
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (status[i] < 0 || status[i] > static_cast<int>(PairStatus::Stick))
        throw InputError(path, "damaged: pair " + std::to_string(pairs[i]) + " has the unknown status " + std::to_string(status[i]));
      checkpoint.status[pairs[i]] = static_cast<PairStatus>(status[i]);
    }
  });
  return checkpoint;
}

}  // namespace suture
