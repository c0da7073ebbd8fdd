#pragma once
#include <suture/partition/Attachments.hpp>

#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Cuts the subdomains out of a share of the mesh. All data of elements, nodes or pairs are first sorted by subdomain, once: the work is
/// linear in the share for any number of subdomains. Local; the constructor's arguments must outlive the Cutter.
class Cutter {
 public:
  /// \param mesh       mesh that the share was made from; read only if the share is the whole mesh
  /// \param share      cut
  /// \param partition  the data that all ranks have
  Cutter(const CellBlock& mesh, const MeshShare& share, const Attachments& attachments, const Partition& partition);
  /// One of the share's subdomains, as its rank receives it.
  SubdomainMesh cut(int subdomain);

 private:
  struct NamedSide {
    const std::string* group;
    Side side;
  };

  void sortRigidGroups();
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
  std::vector<std::vector<RigidGroup>> rigidGroups_;
  NodeSubdomains withMasters_;                 // holders of the nodes if there are rigid groups
  const NodeSubdomains& holders_;              // those, or those of the share
  std::vector<int> localNode_, localElement_;  // work space: numbers in the current subdomain, -1 outside
};

}  // namespace suture
