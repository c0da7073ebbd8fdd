#pragma once
#include <suture/partition/NodeSubdomains.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Cuts the subdomains out of the mesh, on rank 0. Everything that hangs on elements, nodes or pairs is first sorted by subdomain, once, so
/// that the work is linear in the mesh whatever the number of subdomains. Local; what it is made from must outlive it.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const Constraints& constraints, const Partition& partition);
  /// One of the subdomains, as its rank will know it.
  SubdomainMesh cut(int subdomain);

 private:
  struct NamedSide {
    const std::string* group;
    Side side;
  };

  void findSeamSides();
  void shareRows();

  void cutElements(const std::vector<int>& elements, SubdomainMesh& part);
  void cutConstraints(SubdomainMesh& part) const;

  const Mesh& mesh_;
  const Constraints& constraints_;
  const Partition& partition_;
  NodeSubdomains holders_;
  std::vector<std::vector<int>> elements_;                   // of each subdomain
  std::vector<std::vector<GlobalId>> nodes_;                 // of each subdomain, ascending
  std::vector<std::vector<NamedSide>> sides_;                // of each subdomain
  std::vector<ContactRow> rows_;                             // of all pairs
  std::vector<std::vector<int>> rules_;                      // of each subdomain: places in rules
  std::vector<std::vector<std::pair<int, int>>> ends_;       // of each subdomain: pair and place among its ends
  std::vector<std::vector<int>> pairs_;                      // of each subdomain: pairs of its clusters, ascending
  std::vector<std::vector<SubdomainMesh::SeamSide>> seams_;  // of each subdomain; element: of the mesh
  std::vector<int> localNode_, localElement_;                // work space, -1 outside the current subdomain
};

}  // namespace suture
