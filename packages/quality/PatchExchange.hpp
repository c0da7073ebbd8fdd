#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/VertexPatches.hpp>

#include <map>
#include <vector>

namespace suture {

/// Sums over the blocks of a cut mesh, so that a patch is the same on every rank that holds a part of it. As it stands here: for a
/// mesh that was not cut.
class PatchExchange {
 public:
  virtual ~PatchExchange() = default;
  /// Every column becomes the sum over all columns of the same patch (node of the mesh and material), in whatever block they are.
  /// \param perBlock  one matrix a block, one column a patch
  virtual void sum(std::vector<Matrix>& perBlock) const;
  /// Does the work of one rank, so that an exception becomes that of all.
  virtual void local(const std::function<void()>& work) const { work(); }
  /// The largest of all ranks' numbers.
  virtual int largest(int mine) const { return mine; }
};

/// Sums over the subdomains of a body that hold a node: each adds the same numbers in the same order.
class SubdomainExchange : public PatchExchange {
 public:
  /// Collective. \param patches  of each mesh of this rank; they, the meshes and the communicator outlive it
  SubdomainExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<const VertexPatches*>& patches);

  void sum(std::vector<Matrix>& perBlock) const override;
  void local(const std::function<void()>& work) const override;
  int largest(int mine) const override;

 private:
  /// A patch as all ranks know it.
  struct Key {
    GlobalId node;
    double young, poisson;
    GlobalId material;  // as wide as the others: no byte of what is sent is undefined
    bool operator<(const Key& other) const;
  };
  /// A subdomain's part of the patches at nodes that it shares.
  struct Share {
    int subdomain;
    std::vector<Key> patches;
    std::vector<double> columns;  // one after the other
  };

  const Comm& comm_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<std::vector<int>> shared_;     // patches at shared nodes, of each block
  std::vector<std::vector<Key>> keys_;       // of those
  std::map<int, std::vector<int>> toRanks_;  // blocks that share a node with a rank
};

}  // namespace suture
