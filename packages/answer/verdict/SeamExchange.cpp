#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/base/Gather.hpp>
#include <suture/partition/SubdomainRanks.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <set>
#include <unordered_map>

namespace suture {

SeamExchange::SeamExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes) : comm_(comm), meshes_(meshes) {
  const std::unordered_map<int, int> rankOf = ranksOfSubdomains(comm, meshes);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    shared_.emplace_back();
    std::set<int> neighbours;
    for (int node = 0; node < meshes[i].nodes(); ++node) {
      const Span<const int> others = meshes[i].others(node);
      if (others.empty()) continue;
      shared_.back().push_back(node);
      neighbours.insert(others.begin(), others.end());
    }
    std::set<int> ranks{comm.getRank()};
    for (const int neighbour : neighbours) ranks.insert(rankOf.at(neighbour));
    for (const int rank : ranks) toRanks_[rank].push_back(static_cast<int>(i));
  }
}

std::vector<SeamExchange::Share> SeamExchange::exchange(const std::vector<Matrix>& values) const {
  std::map<int, std::string> messages;
  for (const auto& [rank, places] : toRanks_) {
    Packer packer;
    for (const int i : places) {
      std::vector<GlobalId> nodes;
      std::vector<double> columns;
      for (const int node : shared_[i]) {
        nodes.push_back(meshes_[i].globalNodes[node]);
        columns.insert(columns.end(), values[i].col(node).data(), values[i].col(node).data() + values[i].rows());
      }
      packer.put(meshes_[i].id);
      packer.put(nodes);
      packer.put(columns);
    }
    messages[rank] = std::move(packer).bytes();
  }
  std::vector<Share> shares;
  for (const auto& [rank, bytes] : swapWithNeighbours(comm_, messages))
    for (Unpacker unpacker(bytes); !unpacker.done();) {
      Share share;
      unpacker.get(share.subdomain);
      unpacker.get(share.nodes);
      unpacker.get(share.columns);
      shares.push_back(std::move(share));
    }
  std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.subdomain < b.subdomain; });
  return shares;
}

void SeamExchange::sum(std::vector<Matrix>& values) const {
  const std::vector<Share> shares = exchange(values);
  std::unordered_map<GlobalId, std::size_t> placeOf;
  std::vector<double> sums;
  for (const Share& share : shares) {
    const std::size_t width = share.nodes.empty() ? 0 : share.columns.size() / share.nodes.size();
    for (std::size_t n = 0; n < share.nodes.size(); ++n) {
      const auto [at, first] = placeOf.try_emplace(share.nodes[n], sums.size());
      if (first) sums.resize(sums.size() + width, 0.0);
      for (std::size_t k = 0; k < width; ++k) sums[at->second + k] += share.columns[n * width + k];
    }
  }
  for (std::size_t i = 0; i < meshes_.size(); ++i)
    for (const int node : shared_[i])
      values[i].col(node) = Eigen::Map<const Vector>(sums.data() + placeOf.at(meshes_[i].globalNodes[node]), values[i].rows());
}

std::vector<SeamExchange::Difference> SeamExchange::differences(const std::vector<Matrix>& values) const {
  const std::vector<Share> shares = exchange(values);
  std::unordered_map<GlobalId, const double*> lowest;
  for (const Share& share : shares) {
    const std::size_t width = share.nodes.empty() ? 0 : share.columns.size() / share.nodes.size();
    for (std::size_t n = 0; n < share.nodes.size(); ++n) lowest.try_emplace(share.nodes[n], share.columns.data() + n * width);
  }
  std::vector<Difference> all;
  for (std::size_t i = 0; i < meshes_.size(); ++i)
    for (const int node : shared_[i]) {
      const Eigen::Map<const Vector> first(lowest.at(meshes_[i].globalNodes[node]), values[i].rows());
      const double size = (values[i].col(node) - first).norm();
      if (size != 0.0) all.push_back({static_cast<int>(i), node, size});
    }
  return all;
}

}  // namespace suture
