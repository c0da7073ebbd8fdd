#pragma once
#include <suture/partition/Attachments.hpp>

#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Cuts the subdomains out of a share of the mesh. Everything that hangs on elements, nodes or pairs is first sorted by subdomain, once, so
/// that the work is linear in the share whatever the number of subdomains. Local; what it is made from must outlive it.
class Cutter {
 public:
  /// \param mesh       what the share was made from; read only where the share is the whole of it
  /// \param share      cut
  /// \param partition  what all ranks know of it
  Cutter(const CellBlock& mesh, const MeshShare& share, const Attachments& attachments, const Partition& partition);
  /// One of the share's subdomains, as its rank will know it.
  SubdomainMesh cut(int subdomain);

 private:
  struct NamedSide {
    const std::string* group;
    Side side;
  };

  void findSeamSides();
  void findSeamEdges();

  void cutElements(SubdomainMesh& part);
  void cutConstraints(SubdomainMesh& part) const;

  const CellBlock& block_;
  const MeshShare& share_;
  const Attachments& attachments_;
  const Partition& partition_;
  // One for each subdomain; nodes and elements in the numbers of the share.
  std::vector<std::vector<int>> elements_, nodes_;  // ascending
  std::vector<std::vector<NamedSide>> sides_;
  std::vector<std::vector<NodeRule>> rules_;
  std::vector<std::vector<Support>> supports_;
  std::vector<std::vector<SpringDirection>> springs_;
  std::vector<std::vector<SubdomainMesh::ContactEnd>> ends_;
  std::vector<std::vector<SubdomainMesh::SeamSide>> seams_;
  std::vector<std::vector<SubdomainMesh::SeamEdge>> edges_;
  std::vector<int> localNode_, localElement_;  // work space: numbers in the current subdomain, -1 outside
};

}  // namespace suture
