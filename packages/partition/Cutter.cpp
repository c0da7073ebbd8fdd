#include <algorithm>
#include <suture/partition/Cutter.hpp>
#include <tuple>

namespace suture {

Cutter::Cutter(const Mesh& mesh, const Constraints& constraints, const Partition& partition)
    : mesh_(mesh),
      constraints_(constraints),
      partition_(partition),
      holders_(nodeSubdomains(mesh, partition.subdomainOfElement)),
      elements_(partition.subdomains()),
      nodes_(partition.subdomains()),
      sides_(partition.subdomains()),
      rows_(contactRows(mesh, constraints)),
      rules_(partition.subdomains()),
      ends_(partition.subdomains()),
      pairs_(partition.subdomains()),
      seams_(partition.subdomains()),
      localNode_(mesh.nodes(), -1),
      localElement_(mesh.elements(), -1) {
  for (int e = 0; e < mesh.elements(); ++e) elements_[partition.subdomainOfElement[e]].push_back(e);
  for (int node = 0; node < mesh.nodes(); ++node)
    for (int s : holders_.of(node)) nodes_[s].push_back(node);
  for (const auto& [name, sides] : mesh.sideGroups)
    for (const Side& side : sides) sides_[partition.subdomainOfElement[side.element]].push_back({&name, side});
  for (std::size_t r = 0; r < constraints.rules.size(); ++r)
    for (int s : holders_.of(constraints.rules[r].node)) rules_[s].push_back(static_cast<int>(r));
  for (const ContactPair& pair : constraints.pairs)
    for (std::size_t end = 0; end < pair.ends.size(); ++end)
      for (int s : holders_.of(pair.ends[end].node)) ends_[s].push_back({pair.id, static_cast<int>(end)});
  shareRows();
  findSeamSides();
}

// Every row of a cluster goes to all subdomains that hold a node of any pair in it.
void Cutter::shareRows() {
  std::vector<std::vector<int>> members(rows_.size()), holders(rows_.size());  // by the cluster's lowest pair
  for (std::size_t p = 0; p < rows_.size(); ++p) {
    const int cluster = rows_[p].cluster;
    members[cluster].push_back(static_cast<int>(p));
    for (const PairEnd& end : rows_[p].pair.ends)
      holders[cluster].insert(holders[cluster].end(), holders_.of(end.node).begin(), holders_.of(end.node).end());
  }
  for (std::size_t cluster = 0; cluster < rows_.size(); ++cluster) {
    std::vector<int>& all = holders[cluster];
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (int s : all) pairs_[s].insert(pairs_[s].end(), members[cluster].begin(), members[cluster].end());
  }
  for (std::vector<int>& own : pairs_) std::sort(own.begin(), own.end());
}

// Only sides all of whose nodes are shared can lie on a seam: work in proportion to the elements, memory to the seams.
void Cutter::findSeamSides() {
  struct Candidate {
    int low, high, element, side;  // end points first
  };
  std::vector<Candidate> candidates;
  const auto isShared = [this](int node) { return holders_.of(node).size() > 1; };
  for (int e = 0; e < mesh_.elements(); ++e) {
    const Span<const int> nodes = mesh_.nodesOf(e);
    const auto& sides = cellInfo(mesh_.cells[e]).sideNodes;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const auto [low, high] = std::minmax({nodes[sides[i][0]], nodes[sides[i][1]]});
      if (isShared(low) && isShared(high)) candidates.push_back({low, high, e, static_cast<int>(i)});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return std::tie(a.low, a.high, a.element) < std::tie(b.low, b.high, b.element); });
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const Candidate &a = candidates[i - 1], &b = candidates[i];
    if (a.low != b.low || a.high != b.high) continue;
    const int sa = partition_.subdomainOfElement[a.element], sb = partition_.subdomainOfElement[b.element];
    if (sa == sb) continue;
    seams_[sa].push_back({a.element, a.side, sb});
    seams_[sb].push_back({b.element, b.side, sa});
  }
  for (auto& own : seams_)
    std::sort(own.begin(), own.end(), [](const SubdomainMesh::SeamSide& a, const SubdomainMesh::SeamSide& b) {
      return std::tie(a.element, a.side) < std::tie(b.element, b.side);
    });
}

void Cutter::cutElements(const std::vector<int>& elements, SubdomainMesh& part) {
  part.dimension = mesh_.dimension;
  part.axisymmetric = mesh_.axisymmetric;
  part.globalNodes = nodes_[part.id];
  std::size_t corners = 0;
  for (int e : elements) corners += mesh_.nodesOf(e).size();
  part.globalElements.reserve(elements.size());
  part.cells.reserve(elements.size());
  part.offsets.reserve(elements.size() + 1);
  part.connectivity.reserve(corners);
  for (std::size_t i = 0; i < part.globalNodes.size(); ++i) localNode_[part.globalNodes[i]] = static_cast<int>(i);
  for (int e : elements) {
    localElement_[e] = static_cast<int>(part.globalElements.size());
    part.globalElements.push_back(e);
    part.cells.push_back(mesh_.cells[e]);
    if (!mesh_.regions.empty()) part.regions.push_back(mesh_.regions[e]);
    for (int node : mesh_.nodesOf(e)) part.connectivity.push_back(localNode_[node]);
    part.offsets.push_back(static_cast<int>(part.connectivity.size()));
  }
  part.coordinates.reserve(part.globalNodes.size() * mesh_.dimension);
  part.sharedOffsets.reserve(part.globalNodes.size() + 1);
  for (GlobalId node : part.globalNodes) {
    for (int k = 0; k < mesh_.dimension; ++k) part.coordinates.push_back(mesh_.coordinates[node * mesh_.dimension + k]);
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
  for (const auto& [pair, end] : ends_[part.id])
    part.contactEnds.push_back({pair, end, localNode_[constraints_.pairs[pair].ends[end].node]});
  for (int pair : pairs_[part.id]) part.contactRows.push_back(rows_[pair]);
  for (const SubdomainMesh::SeamSide& seam : seams_[part.id])
    part.seamSides.push_back({localElement_[seam.element], seam.side, seam.neighbour});
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

}  // namespace suture
