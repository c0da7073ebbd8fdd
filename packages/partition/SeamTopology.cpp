#include <algorithm>
#include <map>
#include <set>
#include <suture/base/Errors.hpp>
#include <suture/partition/SeamTopology.hpp>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace suture {
namespace {

// The seams that touch some subdomains as a graph: their seam nodes with all holders, linked along seam sides. A node of exactly two
// subdomains lies on no seam but the one between them, so that either of them knows all its sides; the links of other nodes may be
// incomplete, but those are corners whatever their links.
class SeamGraph {
 public:
  explicit SeamGraph(const std::vector<const SubdomainMesh*>& subdomains);
  std::vector<SeamEntity> entities() const;

 private:
  struct Node {
    std::vector<int> holders;      // ascending
    std::vector<GlobalId> linked;  // ascending
  };

  void addNodes(const SubdomainMesh& part);
  void addSides(const SubdomainMesh& part, std::set<std::pair<GlobalId, GlobalId>>& seen);

  // A node of two subdomains through which one seam passes is inside an edge; every other one is a corner.
  static bool isCorner(const Node& node) { return node.holders.size() > 2 || node.linked.size() != 2; }
  SeamEntity edgeThrough(GlobalId start) const;
  void walk(GlobalId from, GlobalId to, SeamEntity& edge) const;

  std::map<GlobalId, Node> nodes_;
};

SeamGraph::SeamGraph(const std::vector<const SubdomainMesh*>& subdomains) {
  std::set<std::pair<GlobalId, GlobalId>> seen;
  for (const SubdomainMesh* part : subdomains) {
    if (part->dimension != 2) throw InternalError("seams in dimension " + std::to_string(part->dimension));
    addNodes(*part);
  }
  for (const SubdomainMesh* part : subdomains) addSides(*part, seen);
  for (auto& [number, node] : nodes_) std::sort(node.linked.begin(), node.linked.end());
}

void SeamGraph::addNodes(const SubdomainMesh& part) {
  for (int i = 0; i < part.nodes(); ++i) {
    const Span<const int> others = part.others(i);
    if (others.empty()) continue;
    std::vector<int>& holders = nodes_[part.globalNodes[i]].holders;
    if (!holders.empty()) continue;  // another subdomain of this rank told
    holders.assign(others.begin(), others.end());
    holders.push_back(part.id);
    std::sort(holders.begin(), holders.end());
  }
}

// `seen`: sides by their end points; with both subdomains on this rank a side comes twice.
void SeamGraph::addSides(const SubdomainMesh& part, std::set<std::pair<GlobalId, GlobalId>>& seen) {
  const auto link = [this](GlobalId a, GlobalId b) {
    nodes_.at(a).linked.push_back(b);
    nodes_.at(b).linked.push_back(a);
  };
  for (const SubdomainMesh::SeamSide& seam : part.seamSides) {
    const std::vector<int> nodes = part.nodesOf(Side{seam.element, seam.side});
    const GlobalId a = part.globalNodes[nodes[0]], b = part.globalNodes[nodes[1]];
    if (!seen.insert(std::minmax(a, b)).second) continue;
    if (nodes.size() > 2) {  // a quadratic side: its middle node comes third
      const GlobalId middle = part.globalNodes[nodes[2]];
      link(a, middle);
      link(middle, b);
    } else {
      link(a, b);
    }
  }
}

// From `from` over `to` up to the next corner, or around a ring back to where the edge began.
void SeamGraph::walk(GlobalId from, GlobalId to, SeamEntity& edge) const {
  for (const Node* node = &nodes_.at(to); !isCorner(*node); node = &nodes_.at(to)) {
    if (to == edge.nodes.front()) return;
    edge.nodes.push_back(to);
    const GlobalId next = node->linked[0] == from ? node->linked[1] : node->linked[0];
    from = std::exchange(to, next);
  }
  edge.endPoints.push_back(to);
}

// `start`: a node inside the edge, the lowest one. The sense depends on the edge alone, not on where the walk began.
SeamEntity SeamGraph::edgeThrough(GlobalId start) const {
  const Node& node = nodes_.at(start);
  SeamEntity edge;
  edge.kind = EntityClass::Edge;
  edge.subdomains = node.holders;
  edge.nodes = {start};
  walk(start, node.linked[0], edge);
  if (edge.endPoints.empty()) return edge;  // a ring: from its lowest node towards the lower neighbour
  std::reverse(edge.nodes.begin(), edge.nodes.end());
  SeamEntity rest;
  rest.nodes = {start};
  walk(start, node.linked[1], rest);
  edge.nodes.insert(edge.nodes.end(), rest.nodes.begin() + 1, rest.nodes.end());
  edge.endPoints.push_back(rest.endPoints.front());
  const auto sense = [](const SeamEntity& e) { return std::make_pair(e.endPoints.front(), e.nodes.front()); };
  const auto against = [](const SeamEntity& e) { return std::make_pair(e.endPoints.back(), e.nodes.back()); };
  if (against(edge) < sense(edge)) {
    std::reverse(edge.nodes.begin(), edge.nodes.end());
    std::reverse(edge.endPoints.begin(), edge.endPoints.end());
  }
  return edge;
}

std::vector<SeamEntity> SeamGraph::entities() const {
  std::vector<SeamEntity> corners, edges;
  std::unordered_set<GlobalId> done;
  for (const auto& [number, node] : nodes_) {  // ascending
    if (isCorner(node)) {
      corners.push_back({EntityClass::Corner, node.holders, {number}, {}});
    } else if (done.insert(number).second) {
      edges.push_back(edgeThrough(number));
      done.insert(edges.back().nodes.begin(), edges.back().nodes.end());
    }
  }
  std::sort(edges.begin(), edges.end(), [](const SeamEntity& a, const SeamEntity& b) {
    return std::tie(a.subdomains, a.nodes.front()) < std::tie(b.subdomains, b.nodes.front());
  });
  corners.insert(corners.end(), std::make_move_iterator(edges.begin()), std::make_move_iterator(edges.end()));
  return corners;
}

}  // namespace

std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains) { return SeamGraph(subdomains).entities(); }

std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains) {
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& part : subdomains) pointers.push_back(&part);
  return findSeams(pointers);
}

}  // namespace suture
