#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/partition/NodeSubdomains.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {
namespace {

// Cuts the subdomains out of the mesh on rank 0. Everything that hangs on elements or nodes is first sorted by subdomain, once, so that the
// work is linear in the mesh whatever the number of subdomains.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const Constraints& constraints, const Partition& partition);
  SubdomainMesh cut(int subdomain);

 private:
  struct NamedSide {
    const std::string* group;
    Side side;
  };

  void cutElements(const std::vector<int>& elements, SubdomainMesh& part);
  void cutConstraints(SubdomainMesh& part) const;

  const Mesh& mesh_;
  const Constraints& constraints_;
  const Partition& partition_;
  NodeSubdomains holders_;
  std::vector<std::vector<int>> elements_;      // of each subdomain
  std::vector<std::vector<NamedSide>> sides_;   // of each subdomain
  std::vector<std::vector<int>> rules_, ends_;  // of each subdomain: places in rules; 2 * pair + (0 for A, 1 for B)
  std::vector<int> localNode_, localElement_;   // work space, -1 outside the current subdomain
};

Cutter::Cutter(const Mesh& mesh, const Constraints& constraints, const Partition& partition)
    : mesh_(mesh),
      constraints_(constraints),
      partition_(partition),
      holders_(nodeSubdomains(mesh, partition.subdomainOfElement, partition.subdomains())),
      elements_(partition.subdomains()),
      sides_(partition.subdomains()),
      rules_(partition.subdomains()),
      ends_(partition.subdomains()),
      localNode_(mesh.nodes(), -1),
      localElement_(mesh.elements(), -1) {
  for (int e = 0; e < mesh.elements(); ++e) elements_[partition.subdomainOfElement[e]].push_back(e);
  for (const auto& [name, sides] : mesh.sideGroups)
    for (const Side& side : sides) sides_[partition.subdomainOfElement[side.element]].push_back({&name, side});
  for (std::size_t r = 0; r < constraints.rules.size(); ++r)
    for (int s : holders_.of(constraints.rules[r].node)) rules_[s].push_back(static_cast<int>(r));
  for (const ContactPair& pair : constraints.pairs) {
    for (int s : holders_.of(pair.nodeA)) ends_[s].push_back(2 * pair.id);
    for (int s : holders_.of(pair.nodeB)) ends_[s].push_back(2 * pair.id + 1);
  }
}

void Cutter::cutElements(const std::vector<int>& elements, SubdomainMesh& part) {
  part.dimension = mesh_.dimension;
  for (int e : elements) {
    localElement_[e] = static_cast<int>(part.globalElements.size());
    part.globalElements.push_back(e);
    part.cells.push_back(mesh_.cells[e]);
    if (!mesh_.regions.empty()) part.regions.push_back(mesh_.regions[e]);
    for (int node : mesh_.nodesOf(e)) {
      part.connectivity.push_back(node);
      if (localNode_[node] < 0) {
        localNode_[node] = 0;
        part.globalNodes.push_back(node);
      }
    }
    part.offsets.push_back(static_cast<int>(part.connectivity.size()));
  }
  std::sort(part.globalNodes.begin(), part.globalNodes.end());
  for (std::size_t i = 0; i < part.globalNodes.size(); ++i) localNode_[part.globalNodes[i]] = static_cast<int>(i);
  for (int& node : part.connectivity) node = localNode_[node];
  for (GlobalId node : part.globalNodes) {
    const auto first = mesh_.coordinates.begin() + node * mesh_.dimension;
    part.coordinates.insert(part.coordinates.end(), first, first + mesh_.dimension);
    for (int s : holders_.of(static_cast<int>(node)))
      if (s != part.id) part.sharedWith.push_back(s);
    part.sharedOffsets.push_back(static_cast<int>(part.sharedWith.size()));
  }
}

void Cutter::cutConstraints(SubdomainMesh& part) const {
  for (const NamedSide& named : sides_[part.id])
    part.sideGroups[*named.group].push_back({localElement_[named.side.element], named.side.side});
  for (int r : rules_[part.id]) {
    part.rules.push_back(constraints_.rules[r]);
    part.rules.back().node = localNode_[constraints_.rules[r].node];
  }
  for (int end : ends_[part.id]) {
    const ContactPair& pair = constraints_.pairs[end / 2];
    const bool sideA = end % 2 == 0;
    part.contactEnds.push_back({pair, localNode_[sideA ? pair.nodeA : pair.nodeB], sideA ? +1 : -1});
  }
}

SubdomainMesh Cutter::cut(int subdomain) {
  SubdomainMesh part;
  part.id = subdomain;
  part.body = partition_.bodyOf[subdomain];
  part.group = partition_.groupOf[subdomain];
  part.name = partition_.names[subdomain];
  cutElements(elements_[subdomain], part);
  cutConstraints(part);
  for (GlobalId node : part.globalNodes) localNode_[node] = -1;
  for (GlobalId e : part.globalElements) localElement_[e] = -1;
  return part;
}

// One list of fields for both directions: `each` puts or gets.
template <typename SubdomainMeshRef, typename Each>
void forEachField(SubdomainMeshRef& part, const Each& each) {
  each(part.dimension);
  each(part.coordinates);
  each(part.cells);
  each(part.offsets);
  each(part.connectivity);
  each(part.regions);
  each(part.id);
  each(part.body);
  each(part.group);
  each(part.name);
  each(part.globalNodes);
  each(part.globalElements);
  each(part.sideGroups);
  each(part.rules);
  each(part.sharedOffsets);
  each(part.sharedWith);
  each(part.contactEnds);
}

}  // namespace

std::vector<SubdomainMesh> distribute(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  std::vector<std::string> bytes(comm.getSize());
  collectivelyOnRoot(comm, "distribution of the mesh", [&] {
    Cutter cutter(mesh, constraints, partition);
    std::vector<Packer> packers(comm.getSize());
    for (int s = 0; s < partition.subdomains(); ++s) {
      const SubdomainMesh part = cutter.cut(s);
      Packer& packer = packers[partition.rankOf[s]];
      forEachField(part, [&](const auto& field) { packer.put(field); });
    }
    for (std::size_t rank = 0; rank < packers.size(); ++rank) bytes[rank] = packers[rank].bytes();
  });
  std::vector<SubdomainMesh> mine;
  const std::string received = scatterFromRoot(comm, bytes);
  collectively(comm, "distribution of the mesh", [&] {
    Unpacker unpacker(received);
    while (!unpacker.done()) {
      mine.emplace_back();
      forEachField(mine.back(), [&](auto& field) { unpacker.get(field); });
    }
  });
  return mine;
}

}  // namespace suture
