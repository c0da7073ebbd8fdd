#include <algorithm>
#include <map>
#include <set>
#include <suture/partition/Cutter.hpp>
#include <tuple>

namespace suture {

namespace {

/// All subdomains that hold a node of a rigid group also hold its masters, and the nodes that may have them when the body has moved.
NodeSubdomains holdersWithMasters(const MeshShare& share, const std::vector<RigidGroup>& rigidGroups) {
  std::map<int, std::set<int>> more;  // holders of masters
  for (const RigidGroup& group : rigidGroups)
    for (const int node : group.nodes)
      for (const int s : share.holders.of(share.localNode(node)))
        for (const std::vector<int>* masters : {&group.masterNodes, &group.positionNodes})
          for (const int master : *masters) more[share.localNode(master)].insert(s);
  NodeSubdomains all;
  const int nodes = static_cast<int>(share.holders.offsets.size()) - 1;
  for (int node = 0; node < nodes; ++node) {
    if (const auto found = more.find(node); found != more.end())
      all.subdomains.insert(all.subdomains.end(), found->second.begin(), found->second.end());
    else
      for (const int s : share.holders.of(node)) all.subdomains.push_back(s);
    all.offsets.push_back(static_cast<int>(all.subdomains.size()));
  }
  return all;
}

}  // namespace

Cutter::Cutter(const CellBlock& mesh, const MeshShare& share, const Attachments& attachments, const Partition& partition)
    : block_(share.block(mesh)),
      share_(share),
      attachments_(attachments),
      partition_(partition),
      elements_(partition.subdomains()),
      nodes_(partition.subdomains()),
      sides_(partition.subdomains()),
      rules_(partition.subdomains()),
      supports_(partition.subdomains()),
      springs_(partition.subdomains()),
      ends_(partition.subdomains()),
      seams_(partition.subdomains()),
      edges_(partition.subdomains()),
      rigidGroups_(partition.subdomains()),
      withMasters_(attachments.rigidGroups.empty() ? NodeSubdomains() : holdersWithMasters(share, attachments.rigidGroups)),
      holders_(attachments.rigidGroups.empty() ? share.holders : withMasters_),
      localNode_(block_.nodes(), -1),
      localElement_(block_.elements(), -1) {
  for (int e = 0; e < block_.elements(); ++e) elements_[share.subdomainOfElement[e]].push_back(e);
  for (int node = 0; node < block_.nodes(); ++node)
    for (int s : holders_.of(node)) nodes_[s].push_back(node);
  for (const auto& [name, sides] : attachments.sideGroups)
    for (const Side& side : sides) {
      const int e = share.localElement(side.element);
      sides_[share.subdomainOfElement[e]].push_back({&name, {e, side.side}});
    }
  for (NodeRule rule : attachments.rules) {
    rule.node = share.localNode(rule.node);
    for (int s : holders_.of(rule.node)) rules_[s].push_back(rule);
  }
  for (Support support : attachments.supports) {
    support.node = share.localNode(support.node);
    for (int s : holders_.of(support.node)) supports_[s].push_back(support);
  }
  for (SpringDirection spring : attachments.springs) {
    spring.element = share.localElement(spring.element);
    spring.node = share.localNode(spring.node);
    springs_[share.subdomainOfElement[spring.element]].push_back(spring);
  }
  for (SubdomainMesh::ContactEnd end : attachments.contactEnds) {
    end.node = share.localNode(end.node);
    for (int s : holders_.of(end.node)) ends_[s].push_back(end);
  }
  sortRigidGroups();
  findSeamSides();
  if (block_.dimension == 3) findSeamEdges();
}

/// Each subdomain gets the part of a group that it holds.
void Cutter::sortRigidGroups() {
  const int d = block_.dimension;
  for (const RigidGroup& group : attachments_.rigidGroups) {
    std::map<int, std::vector<std::size_t>> placesOf;  // by subdomain
    for (std::size_t place = 0; place < group.nodes.size(); ++place)
      for (const int s : holders_.of(share_.localNode(group.nodes[place]))) placesOf[s].push_back(place);
    for (const auto& [s, places] : placesOf) {
      RigidGroup& part = rigidGroups_[static_cast<std::size_t>(s)].emplace_back();
      part.condition = group.condition;
      part.point = group.point;
      part.moved = group.moved;
      part.turned = group.turned;
      part.masterComponents = group.masterComponents;
      part.axes = group.axes;
      for (const int master : group.masterNodes) part.masterNodes.push_back(share_.localNode(master));
      for (const std::size_t place : places) {
        part.nodes.push_back(share_.localNode(group.nodes[place]));
        part.coefficients.insert(part.coefficients.end(), group.row(place, 0, d), group.row(place, 0, d) + d * group.masters());
      }
    }
  }
}

// Only sides whose vertices are all shared can lie on a seam: work proportional to the elements, memory to the seams.
void Cutter::findSeamSides() {
  struct Candidate {
    SideKey key;
    int element, side;
  };
  std::vector<Candidate> candidates;
  const auto isShared = [this](int node) { return holders_.of(node).size() > 1; };
  for (int e = 0; e < block_.elements(); ++e) {
    const CellInfo& cell = cellInfo(block_.cells[e]);
    const Span<const int> nodes = block_.nodesOf(e);
    if (block_.dimension == 3) {  // most elements of a subdomain have no side on its boundary
      int shared = 0;
      for (int k = 0; k < cell.vertices; ++k) shared += isShared(nodes[k]);
      if (shared < 3) continue;
    }
    forEachSide(block_, e, [&](const SideKey& key, const Side& side) {
      for (const int local : cell.sideNodes[side.side])
        if (local < cell.vertices && !isShared(nodes[local])) return;
      candidates.push_back({key, e, side.side});
    });
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.key.low, a.key.rest, a.element) < std::tie(b.key.low, b.key.rest, b.element);
  });
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const Candidate &a = candidates[i - 1], &b = candidates[i];
    if (!(a.key == b.key)) continue;
    const int sa = share_.subdomainOfElement[a.element], sb = share_.subdomainOfElement[b.element];
    if (sa == sb) continue;
    seams_[sa].push_back({a.element, a.side, sb});
    seams_[sb].push_back({b.element, b.side, sa});
  }
  for (auto& own : seams_)
    std::sort(own.begin(), own.end(), [](const SubdomainMesh::SeamSide& a, const SubdomainMesh::SeamSide& b) {
      return std::tie(a.element, a.side) < std::tie(b.element, b.side);
    });
}

// A subdomain does not know the elements of subdomains that it meets only along an edge; the share has all elements.
void Cutter::findSeamEdges() {
  struct Candidate {
    int low, high, middle, subdomain;
  };
  std::vector<Candidate> all, onSides;
  const auto isShared = [this](int node) { return holders_.of(node).size() > 1; };
  const auto candidate = [&](int e, int edge, int subdomain) {
    const CellInfo& cell = cellInfo(block_.cells[e]);
    const Span<const int> nodes = block_.nodesOf(e);
    const int a = nodes[cell.edges[edge][0]], b = nodes[cell.edges[edge][1]];
    return Candidate{std::min(a, b), std::max(a, b), cell.order == 2 ? nodes[cell.vertices + edge] : -1, subdomain};
  };
  for (int e = 0; e < block_.elements(); ++e) {
    const CellInfo& cell = cellInfo(block_.cells[e]);
    const Span<const int> nodes = block_.nodesOf(e);
    for (std::size_t k = 0; k < cell.edges.size(); ++k)
      if (isShared(nodes[cell.edges[k][0]]) && isShared(nodes[cell.edges[k][1]]))
        all.push_back(candidate(e, static_cast<int>(k), share_.subdomainOfElement[e]));
  }
  for (std::size_t s = 0; s < seams_.size(); ++s)
    for (const SubdomainMesh::SeamSide& seam : seams_[s]) {
      const CellInfo& cell = cellInfo(block_.cells[seam.element]);
      const std::vector<int>& side = cell.sideNodes[seam.side];
      const auto isOn = [&](int local) { return std::find(side.begin(), side.end(), local) != side.end(); };
      for (std::size_t k = 0; k < cell.edges.size(); ++k)
        if (isOn(cell.edges[k][0]) && isOn(cell.edges[k][1]))
          onSides.push_back(candidate(seam.element, static_cast<int>(k), seam.neighbour));
    }
  const auto before = [](const Candidate& a, const Candidate& b) {
    return std::tie(a.low, a.high, a.subdomain) < std::tie(b.low, b.high, b.subdomain);
  };
  const auto same = [](const Candidate& a, const Candidate& b) {
    return std::tie(a.low, a.high, a.subdomain) == std::tie(b.low, b.high, b.subdomain);
  };
  std::sort(all.begin(), all.end(), before);
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  std::sort(onSides.begin(), onSides.end(), before);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].low == all[begin].low && all[end].high == all[begin].high) ++end;
    const auto count = end - begin;
    if (count < 2) continue;
    // Two subdomains that share a side containing the edge know it as an edge of this side.
    if (count == 2 && std::binary_search(onSides.begin(), onSides.end(), all[begin], before)) continue;
    SubdomainMesh::SeamEdge edge{{all[begin].low, all[begin].high}, all[begin].middle, {}};
    for (std::size_t i = begin; i < end; ++i) edge.sharers.push_back(all[i].subdomain);
    for (const int s : edge.sharers) edges_[s].push_back(edge);
  }
}

void Cutter::cutElements(SubdomainMesh& part) {
  const std::vector<int>&elements = elements_[part.id], &nodes = nodes_[part.id];
  part.dimension = block_.dimension;
  part.axisymmetric = block_.axisymmetric;
  std::size_t corners = 0;
  for (int e : elements) corners += block_.nodesOf(e).size();
  part.globalElements.reserve(elements.size());
  part.cells.reserve(elements.size());
  part.offsets.reserve(elements.size() + 1);
  part.connectivity.reserve(corners);
  for (std::size_t i = 0; i < nodes.size(); ++i) localNode_[nodes[i]] = static_cast<int>(i);
  for (int e : elements) {
    localElement_[e] = static_cast<int>(part.globalElements.size());
    part.globalElements.push_back(share_.globalElement(e));
    part.cells.push_back(block_.cells[e]);
    if (!block_.regions.empty()) part.regions.push_back(block_.regions[e]);
    for (int node : block_.nodesOf(e)) part.connectivity.push_back(localNode_[node]);
    part.offsets.push_back(static_cast<int>(part.connectivity.size()));
  }
  for (Coating coating : block_.coatings) {
    if (share_.subdomainOfElement[coating.element] != part.id) continue;
    const Span<const int> outer = block_.outerNodes(coating);
    coating.element = localElement_[coating.element];
    coating.begin = static_cast<int>(part.coatingNodes.size());
    part.coatings.push_back(coating);
    for (const int node : outer) part.coatingNodes.push_back(localNode_[node]);
  }
  part.globalNodes.reserve(nodes.size());
  part.coordinates.reserve(nodes.size() * block_.dimension);
  part.sharedOffsets.reserve(nodes.size() + 1);
  for (int node : nodes) {
    part.globalNodes.push_back(share_.globalNode(node));
    for (int k = 0; k < block_.dimension; ++k) part.coordinates.push_back(block_.coordinates[std::size_t(node) * block_.dimension + k]);
    for (int s : holders_.of(node))
      if (s != part.id) part.sharedWith.push_back(s);
    part.sharedOffsets.push_back(static_cast<int>(part.sharedWith.size()));
  }
}

void Cutter::cutConstraints(SubdomainMesh& part) const {
  for (const NamedSide& named : sides_[part.id])
    part.sideGroups[*named.group].push_back({localElement_[named.side.element], named.side.side});
  part.rules = rules_[part.id];
  for (NodeRule& rule : part.rules) rule.node = localNode_[rule.node];
  part.supports = supports_[part.id];
  for (Support& support : part.supports) support.node = localNode_[support.node];
  part.rigidGroups = rigidGroups_[part.id];
  for (RigidGroup& group : part.rigidGroups)
    for (std::vector<int>* nodes : {&group.nodes, &group.masterNodes})
      for (int& node : *nodes) node = localNode_[node];
  part.springs = springs_[part.id];
  for (SpringDirection& spring : part.springs) spring = {localElement_[spring.element], localNode_[spring.node], spring.direction};
  part.contactEnds = ends_[part.id];
  for (SubdomainMesh::ContactEnd& end : part.contactEnds) end.node = localNode_[end.node];
  if (const auto rows = attachments_.rowsOf.find(part.id); rows != attachments_.rowsOf.end())
    for (int place : rows->second) part.contactRows.push_back(attachments_.rows[place]);
  part.seamSides = seams_[part.id];
  for (SubdomainMesh::SeamSide& seam : part.seamSides) seam.element = localElement_[seam.element];
  part.seamEdges = edges_[part.id];
  for (SubdomainMesh::SeamEdge& edge : part.seamEdges) {
    for (int& vertex : edge.vertices) vertex = localNode_[vertex];
    if (edge.middle >= 0) edge.middle = localNode_[edge.middle];
  }
  if (const auto cells = attachments_.cellsOf.find(part.id); cells != attachments_.cellsOf.end())
    for (const int place : cells->second) part.contactCells.push_back(attachments_.cells[place]);
}

SubdomainMesh Cutter::cut(int subdomain) {
  SubdomainMesh part;
  part.id = subdomain;
  part.body = partition_.bodyOf[subdomain];
  part.group = partition_.groupOf[subdomain];
  part.name = partition_.names[subdomain];
  cutElements(part);
  cutConstraints(part);
  for (int node : nodes_[subdomain]) localNode_[node] = -1;
  for (int e : elements_[subdomain]) localElement_[e] = -1;
  return part;
}

}  // namespace suture
