#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/partition/RenewConstraints.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

/// Constraints in the numbers of the mesh; size of boundaries and contact.
struct RenewedConstraints {
  std::vector<NodeRule> rules;
  std::vector<Support> supports;
  std::vector<RigidGroup> rigidGroups;
  std::vector<ContactRow> rows;         ///< all pairs, by id
  std::vector<std::vector<int>> cells;  ///< in 3D: all cells of contact pieces, by ids of pairs

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.rules), each(self.supports), each(self.rigidGroups), each(self.rows), each(self.cells);
  }
};

/// Local number of a node of the mesh; -1: it is not in the subdomain.
int localNode(const SubdomainMesh& mesh, GlobalId node) {
  const auto at = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), node);
  return at == mesh.globalNodes.end() || *at != node ? -1 : static_cast<int>(at - mesh.globalNodes.begin());
}

template <typename OfNode>
void takeOwn(const SubdomainMesh& mesh, const std::vector<OfNode>& all, std::vector<OfNode>& own) {
  own.clear();
  for (const OfNode& one : all)
    if (const int node = localNode(mesh, one.node); node >= 0) own.push_back(one), own.back().node = node;
}

std::vector<RigidGroup> ownGroups(const SubdomainMesh& mesh, const std::vector<RigidGroup>& all) {
  const int d = mesh.dimension;
  std::vector<RigidGroup> own;
  for (const RigidGroup& group : all) {
    RigidGroup part = group;
    part.nodes.clear(), part.coefficients.clear();
    part.motions = {}, part.factor = 0;
    for (std::size_t place = 0; place < group.nodes.size(); ++place) {
      const int node = localNode(mesh, group.nodes[place]);
      if (node < 0) continue;
      part.nodes.push_back(node);
      part.coefficients.insert(part.coefficients.end(), group.row(place, 0, d), group.row(place, 0, d) + d * group.masters());
    }
    if (part.nodes.empty()) continue;
    for (int& master : part.masterNodes) {
      master = localNode(mesh, master);
      if (master < 0) throw InternalError("a master of a rigid group is not in a subdomain with nodes of the group");
    }
    part.positionNodes.clear();
    own.push_back(std::move(part));
  }
  return own;
}

/// Clusters of which a subdomain holds an unknown: through a node, or through a node of a rigid group that moves, whose masters it has.
std::vector<char> heldClusters(const SubdomainMesh& mesh, const RenewedConstraints& renewed) {
  std::set<int> ofGroups;  // nodes of the mesh in groups of which a part is here
  for (const RigidGroup& group : renewed.rigidGroups) {
    const bool isHere = std::any_of(mesh.rigidGroups.begin(), mesh.rigidGroups.end(),
                                    [&](const RigidGroup& own) { return own.condition == group.condition; });
    if (isHere && group.masters() > 0) ofGroups.insert(group.nodes.begin(), group.nodes.end());
  }
  std::vector<char> held(renewed.rows.size(), 0);
  for (const ContactRow& row : renewed.rows)
    for (const PairEnd& end : row.pair.ends)
      if (localNode(mesh, end.node) >= 0 || ofGroups.count(end.node) > 0) held[static_cast<std::size_t>(row.cluster)] = 1;
  return held;
}

void takeContact(const RenewedConstraints& renewed, SubdomainMesh& mesh) {
  mesh.contactEnds.clear(), mesh.contactRows.clear(), mesh.contactCells.clear();
  const std::vector<char> held = heldClusters(mesh, renewed);
  const auto isHeld = [&](const ContactRow& row) { return held[static_cast<std::size_t>(row.cluster)] != 0; };
  for (const ContactRow& row : renewed.rows) {
    if (isHeld(row)) mesh.contactRows.push_back(row);
    for (std::size_t end = 0; end < row.pair.ends.size(); ++end)
      if (const int node = localNode(mesh, row.pair.ends[end].node); node >= 0)
        mesh.contactEnds.push_back({row.pair.id, static_cast<int>(end), node});
  }
  for (const std::vector<int>& cell : renewed.cells)
    if (std::any_of(cell.begin(), cell.end(), [&](int pair) { return isHeld(renewed.rows[static_cast<std::size_t>(pair)]); }))
      mesh.contactCells.push_back(cell);
}

RenewedConstraints gathered(const Mesh& mesh, const Constraints& constraints) {
  RenewedConstraints all{constraints.rules, constraints.supports, constraints.rigidGroups, contactRows(mesh, constraints), {}};
  if (mesh.dimension == 3)  // along a line the numbers of pairs define the neighbours
    for (const ContactPiece& piece : constraints.pieces) all.cells.insert(all.cells.end(), piece.cells.begin(), piece.cells.end());
  return all;
}

}  // namespace

void renewConstraints(const Comm& comm, const Mesh& mesh, const Constraints& constraints, std::vector<SubdomainMesh>& meshes) {
  Packer packer;
  collectivelyOnRoot(comm, "renewing the constraints", [&] { packer.put(gathered(mesh, constraints)); });
  RenewedConstraints renewed;
  Unpacker(broadcast(comm, packer.bytes())).get(renewed);
  collectively(comm, "renewing the constraints", [&] {
    for (SubdomainMesh& one : meshes) {
      takeOwn(one, renewed.rules, one.rules);
      takeOwn(one, renewed.supports, one.supports);
      one.rigidGroups = ownGroups(one, renewed.rigidGroups);
      takeContact(renewed, one);
    }
  });
}

}  // namespace suture
