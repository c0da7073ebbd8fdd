#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/quality/ErrorEstimate.hpp>
#include <suture/quality/PatchRecovery.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace suture {

namespace {

/// A patch as all ranks know it.
struct Key {
  GlobalId node;
  double young, poisson;
  GlobalId material;  // as wide as the others: no byte of what is sent is undefined
  bool operator<(const Key& other) const {
    return std::tie(node, young, poisson, material) < std::tie(other.node, other.young, other.poisson, other.material);
  }
};

/// A subdomain's part of the patches at nodes that it shares.
struct Share {
  int subdomain;
  std::vector<Key> patches;
  std::vector<double> columns;  // one after the other
};

/// Subdomains tell those of their body that hold a node of theirs.
class SubdomainExchange : public PatchExchange {
 public:
  SubdomainExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<PatchRecovery>& blocks)
      : comm_(comm), meshes_(meshes) {
    std::vector<int> mine;
    for (const SubdomainMesh& mesh : meshes) mine.push_back(mesh.id);
    Packer packer;
    packer.put(mine);
    std::map<int, int> rankOf;
    const std::vector<std::string> all = allGather(comm, packer.bytes());
    for (std::size_t rank = 0; rank < all.size(); ++rank)
      for (const int id : Unpacker(all[rank]).get<std::vector<int>>()) rankOf[id] = static_cast<int>(rank);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      shared_.emplace_back();
      keys_.emplace_back();
      std::set<int> ranks{comm.getRank()};  // a rank hears of its own, too: everybody then adds the same numbers in the same order
      for (std::size_t p = 0; p < blocks[i].patches().size(); ++p) {
        const PatchRecovery::Patch& patch = blocks[i].patches()[p];
        const auto others = meshes[i].others(patch.node);
        if (others.empty()) continue;
        shared_.back().push_back(static_cast<int>(p));
        keys_.back().push_back({meshes[i].globalNodes[patch.node], patch.young, patch.poisson, patch.material});
        for (const int other : others) ranks.insert(rankOf.at(other));
      }
      for (const int rank : ranks) toRanks_[rank].push_back(static_cast<int>(i));
    }
  }

  void sum(std::vector<Matrix>& perBlock) const override {
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

  void local(const std::function<void()>& work) const override { collectively(comm_, "recovering stresses", work); }

  int largest(int mine) const override {
    int all = 0;
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
    return all;
  }

 private:
  const Comm& comm_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<std::vector<int>> shared_;     // patches at shared nodes, of each block
  std::vector<std::vector<Key>> keys_;       // of those
  std::map<int, std::vector<int>> toRanks_;  // blocks that share a node with a rank
};

}  // namespace

std::vector<PatchRecovery> recoverStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                           const std::vector<Vector>& displacement) {
  std::vector<PatchRecovery> blocks;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubdomainMesh* mesh = &meshes[i];
    blocks.emplace_back(
        *mesh, [mesh, &model](int element) -> const Material& { return model.materialOf(*mesh, element, mesh->body); }, model.plane,
        displacement[i], InitialState(model, mesh->body));
  }
  recoverPatches(blocks, SubdomainExchange(comm, meshes, blocks));
  return blocks;
}

DiscretisationError estimateError(const Comm& comm, const std::vector<PatchRecovery>& recovered) {
  DiscretisationError result;
  double squares[2] = {0.0, 0.0}, all[2];
  collectively(comm, "recovering stresses", [&] {
    for (const PatchRecovery& block : recovered) {
      const ElementErrors errors = block.errors();
      squares[0] += errors.error.sum();
      squares[1] += errors.norm.sum();
      result.ofElements.push_back(errors.error.cwiseSqrt());
    }
  });
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, squares, all);
  result.energyNorm = std::sqrt(all[0]);
  result.solutionNorm = std::sqrt(all[1]);
  return result;
}

DiscretisationError estimateError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<Vector>& displacement) {
  return estimateError(comm, recoverStresses(comm, meshes, model, displacement));
}

}  // namespace suture
