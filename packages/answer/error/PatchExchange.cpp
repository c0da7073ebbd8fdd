#include <suture/answer/error/PatchExchange.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/SubdomainRanks.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <set>
#include <tuple>

namespace suture {

void PatchExchange::sum(std::vector<Matrix>&) const {}

bool SubdomainExchange::Key::operator<(const Key& other) const {
  return std::tie(node, young, poisson, material) < std::tie(other.node, other.young, other.poisson, other.material);
}

SubdomainExchange::SubdomainExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                     const std::vector<const VertexPatches*>& patches)
    : comm_(comm), meshes_(meshes) {
  const std::unordered_map<int, int> rankOf = ranksOfSubdomains(comm, meshes);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    shared_.emplace_back();
    keys_.emplace_back();
    std::set<int> ranks{comm.getRank()};  // including this rank, so that all ranks add the same numbers in the same order
    // A subdomain also holds the masters of its rigid groups, at which it may have no patches: ranks are neighbours by nodes, so that both
    // expect a message.
    for (int node = 0; node < meshes[i].nodes(); ++node)
      for (const int other : meshes[i].others(node)) ranks.insert(rankOf.at(other));
    for (std::size_t p = 0; p < patches[i]->all.size(); ++p) {
      const VertexPatches::Patch& patch = patches[i]->all[p];
      if (meshes[i].others(patch.node).empty()) continue;
      shared_.back().push_back(static_cast<int>(p));
      keys_.back().push_back({meshes[i].globalNodes[patch.node], patch.young, patch.poisson, patch.material});
    }
    for (const int rank : ranks) toRanks_[rank].push_back(static_cast<int>(i));
  }
}

void SubdomainExchange::sum(std::vector<Matrix>& perBlock) const {
  std::map<int, std::string> messages;
  for (const auto& [rank, blocks] : toRanks_) {
    Packer packer;
    for (const int i : blocks) {
      packer.put(meshes_[i].id);
      packer.put(keys_[i]);
      std::vector<double> columns;
      for (const int p : shared_[i])
        columns.insert(columns.end(), perBlock[i].col(p).data(), perBlock[i].col(p).data() + perBlock[i].rows());
      packer.put(columns);
    }
    messages[rank] = packer.bytes();
  }
  std::vector<Share> shares;
  for (const auto& [rank, bytes] : swapWithNeighbours(comm_, messages))
    for (Unpacker unpacker(bytes); !unpacker.done();) {
      Share share;
      unpacker.get(share.subdomain);
      unpacker.get(share.patches);
      unpacker.get(share.columns);
      shares.push_back(std::move(share));
    }
  std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.subdomain < b.subdomain; });
  std::map<Key, Vector> sums;
  for (const Share& share : shares) {
    const auto width = static_cast<Eigen::Index>(share.patches.empty() ? 0 : share.columns.size() / share.patches.size());
    for (std::size_t k = 0; k < share.patches.size(); ++k) {
      const Eigen::Map<const Vector> column(share.columns.data() + k * width, width);
      const auto [at, first] = sums.try_emplace(share.patches[k], column);
      if (!first) at->second += column;
    }
  }
  for (std::size_t i = 0; i < perBlock.size(); ++i)
    for (std::size_t k = 0; k < shared_[i].size(); ++k) perBlock[i].col(shared_[i][k]) = sums.at(keys_[i][k]);
}

void SubdomainExchange::local(const std::function<void()>& work) const { collectively(comm_, "recovering stresses", work); }

int SubdomainExchange::largest(int mine) const {
  int all = 0;
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace suture
