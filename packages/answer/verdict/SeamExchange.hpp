#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <vector>

namespace suture {

/// Sums at nodes shared by several subdomains. Every rank adds in the same order, so that all subdomains at a node get the same number.
class SeamExchange {
 public:
  /// Collective. `meshes` must outlive it.
  SeamExchange(const Comm& comm, const std::vector<SubdomainMesh>& meshes);

  /// Replaces the columns of shared nodes by their sums over all subdomains. Collective.
  /// \param values  of each mesh: any number of rows (the same everywhere) x nodes
  void sum(std::vector<Matrix>& values) const;

  /// A node whose values differ between two subdomains.
  struct Difference {
    int mesh;  ///< index in `meshes`
    int node;  ///< local
    double size;
  };
  /// Distances, if nonzero, of the columns of shared nodes from those of the lowest subdomain there. Collective.
  std::vector<Difference> differences(const std::vector<Matrix>& values) const;

 private:
  struct Share {
    int subdomain;
    std::vector<GlobalId> nodes;
    std::vector<double> columns;
  };
  std::vector<Share> exchange(const std::vector<Matrix>& values) const;

  const Comm& comm_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<std::vector<int>> shared_;     // nodes of each mesh that other subdomains share
  std::map<int, std::vector<int>> toRanks_;  // meshes that share a node with a rank
};

}  // namespace suture
