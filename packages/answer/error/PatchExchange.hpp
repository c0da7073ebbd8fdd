#pragma once
#include <suture/answer/error/VertexPatches.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <vector>

namespace suture {

/// Sums over the blocks of a partitioned mesh, so that a patch is the same on every rank that has a part of it. This base class is for an
/// unpartitioned mesh.
class PatchExchange {
 public:
  virtual ~PatchExchange() = default;
  /// Replaces every column by the sum over all columns of the same patch (node of the mesh and material), over all blocks.
  /// \param perBlock  one matrix per block, one column per patch
  virtual void sum(std::vector<Matrix>& perBlock) const;
  /// Runs the work of one rank; an exception is raised on all ranks.
  virtual void local(const std::function<void()>& work) const { work(); }
  /// Maximum over all ranks.
  virtual int largest(int mine) const { return mine; }
};

/// Sums over the subdomains of a body that share a node; all add the same numbers in the same order.
class SubdomainExchange : public PatchExchange {
 public:
  /// Collective. \param patches  of each mesh of this rank; patches, meshes and communicator must outlive this object
  SubdomainExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<const VertexPatches*>& patches);

  void sum(std::vector<Matrix>& perBlock) const override;
  void local(const std::function<void()>& work) const override;
  int largest(int mine) const override;

 private:
  /// Identifies a patch across ranks.
  struct Key {
    GlobalId node;
    double young, poisson;
    GlobalId material;  // as wide as the others, so that no padding bytes are sent
    bool operator<(const Key& other) const;
  };
  /// A subdomain's part of the patches at shared nodes.
  struct Share {
    int subdomain;
    std::vector<Key> patches;
    std::vector<double> columns;  // one after the other
  };

  const Comm& comm_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<std::vector<int>> shared_;     // patches at shared nodes, of each block
  std::vector<std::vector<Key>> keys_;       // keys of the patches in shared_
  std::map<int, std::vector<int>> toRanks_;  // blocks that share a node with a rank
};

}  // namespace suture
