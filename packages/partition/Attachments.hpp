#pragma once
#include <suture/partition/Partition.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/partition/cut/MeshShare.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Named sides, rules and contact of the bodies that a rank cuts, in the numbers of the mesh, collected on rank 0. Its size is that of
/// boundaries and contact.
struct Attachments {
  SideGroups sideGroups;
  std::vector<NodeRule> rules;
  std::vector<Support> supports;
  std::vector<RigidGroup> rigidGroups;
  std::vector<SpringDirection> springs;
  std::vector<SubdomainMesh::ContactEnd> contactEnds;  ///< by pair, then end
  std::vector<ContactRow> rows;                        ///< rows that any subdomain of these bodies needs
  std::map<int, std::vector<int>> rowsOf;              ///< subdomain -> indices in rows, by pair
  std::vector<std::vector<int>> cells;                 ///< in 3D: cells with a pair whose row any of these subdomains has
  std::map<int, std::vector<int>> cellsOf;             ///< subdomain -> indices in cells, ascending

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.sideGroups), each(self.rules), each(self.supports), each(self.rigidGroups), each(self.springs), each(self.contactEnds),
        each(self.rows), each(self.rowsOf), each(self.cells), each(self.cellsOf);
  }
};

/// Attachments of each rank. Local (rank 0).
/// \param share           of rank 0, which knows the rank of each body
/// \param contactHolders  subdomains of nodesInContact()
std::vector<Attachments> attachmentsOf(const Mesh& mesh, const Constraints& constraints, const Partition& partition, const MeshShare& share,
                                       int ranks, const NodeSubdomains& contactHolders);

}  // namespace suture
