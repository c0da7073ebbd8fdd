#include <algorithm>
#include <map>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/partition/SeamTopology.hpp>
#include <unordered_map>
#include <utility>

namespace suture {
namespace {

// A side on the boundary of a subdomain whose nodes are all held by others, too: a candidate for the seam. Third node: of quadratic sides.
struct Candidate {
  GlobalId low, high, middle;  // middle: -1 where there is none
};

// What one subdomain tells the others.
void packCandidates(const SubdomainMesh& part, Packer& packer) {
  if (part.dimension != 2) throw InternalError("seams in dimension " + std::to_string(part.dimension));
  std::map<std::pair<GlobalId, GlobalId>, std::pair<int, Candidate>> sides;  // end points -> how many elements, side
  for (int e = 0; e < part.elements(); ++e) {
    const Span<const int> nodes = part.nodesOf(e);
    for (const std::vector<int>& side : cellInfo(part.cells[e]).sideNodes) {
      if (std::any_of(side.begin(), side.end(), [&](int i) { return part.others(nodes[i]).empty(); })) continue;
      const auto [low, high] = std::minmax({part.globalNodes[nodes[side[0]]], part.globalNodes[nodes[side[1]]]});
      const GlobalId middle = side.size() > 2 ? part.globalNodes[nodes[side[2]]] : -1;
      auto& entry = sides[{low, high}];
      ++entry.first;
      entry.second = {low, high, middle};
    }
  }
  std::vector<Candidate> candidates;
  for (const auto& [ends, entry] : sides)
    if (entry.first == 1) candidates.push_back(entry.second);
  packer.put(candidates);

  // The holders of a node are told by the first of them.
  std::vector<GlobalId> nodes;
  std::vector<std::vector<int>> holders;
  for (int i = 0; i < part.nodes(); ++i) {
    const Span<const int> others = part.others(i);
    if (others.empty() || *std::min_element(others.begin(), others.end()) < part.id) continue;
    nodes.push_back(part.globalNodes[i]);
    holders.emplace_back(others.begin(), others.end());
    holders.back().push_back(part.id);
    std::sort(holders.back().begin(), holders.back().end());
  }
  packer.put(nodes);
  packer.put(holders);
}

// The seams of all subdomains as a graph: seam nodes with their holders, linked along seam sides.
class SeamGraph {
 public:
  explicit SeamGraph(const std::vector<std::string>& messages);
  std::vector<SeamEntity> entities() const;

 private:
  struct Node {
    std::vector<int> holders;
    std::vector<GlobalId> linked;  // ascending
  };

  // A node of two subdomains through which one seam passes is inside an edge; every other one is a corner.
  static bool isCorner(const Node& node) { return node.holders.size() > 2 || node.linked.size() != 2; }
  SeamEntity edgeThrough(GlobalId start) const;
  void walk(GlobalId from, GlobalId to, SeamEntity& edge) const;

  std::map<GlobalId, Node> nodes_;
};

SeamGraph::SeamGraph(const std::vector<std::string>& messages) {
  std::map<std::pair<GlobalId, GlobalId>, std::pair<int, GlobalId>> sides;  // end points -> how many subdomains, middle node
  for (const std::string& message : messages) {
    Unpacker unpacker(message);
    while (!unpacker.done()) {
      std::vector<Candidate> candidates;
      std::vector<GlobalId> numbers;
      std::vector<std::vector<int>> holders;
      unpacker.get(candidates);
      unpacker.get(numbers);
      unpacker.get(holders);
      for (const Candidate& side : candidates) {
        auto& entry = sides[{side.low, side.high}];
        ++entry.first;
        entry.second = side.middle;
      }
      for (std::size_t i = 0; i < numbers.size(); ++i) nodes_[numbers[i]].holders = holders[i];
    }
  }
  const auto link = [this](GlobalId a, GlobalId b) {
    nodes_.at(a).linked.push_back(b);
    nodes_.at(b).linked.push_back(a);
  };
  for (const auto& [ends, entry] : sides) {
    // Alone: a side on the boundary of the body between two seam nodes.
    if (entry.first != 2) continue;
    if (entry.second < 0) {
      link(ends.first, ends.second);
    } else {
      link(ends.first, entry.second);
      link(entry.second, ends.second);
    }
  }
  for (auto& [number, node] : nodes_) std::sort(node.linked.begin(), node.linked.end());
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

// `start`: a node inside the edge.
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
  std::unordered_map<GlobalId, bool> done;
  for (const auto& [number, node] : nodes_) {  // ascending
    if (isCorner(node)) {
      corners.push_back({EntityClass::Corner, node.holders, {number}, {}});
    } else if (!done[number]) {
      edges.push_back(edgeThrough(number));
      for (GlobalId along : edges.back().nodes) done[along] = true;
    }
  }
  std::sort(edges.begin(), edges.end(), [](const SeamEntity& a, const SeamEntity& b) {
    return std::tie(a.subdomains, a.nodes.front()) < std::tie(b.subdomains, b.nodes.front());
  });
  corners.insert(corners.end(), std::make_move_iterator(edges.begin()), std::make_move_iterator(edges.end()));
  return corners;
}

}  // namespace

std::vector<SeamEntity> findSeams(const Comm& comm, const std::vector<SubdomainMesh>& subdomains) {
  Packer packer;
  collectively(comm, "topology of the seams", [&] {
    for (const SubdomainMesh& part : subdomains) packCandidates(part, packer);
  });
  const std::vector<std::string> messages = allGather(comm, packer.bytes());
  std::vector<SeamEntity> mine;
  collectively(comm, "topology of the seams", [&] {
    std::vector<int> here;
    for (const SubdomainMesh& part : subdomains) here.push_back(part.id);
    std::sort(here.begin(), here.end());
    for (SeamEntity& entity : SeamGraph(messages).entities())
      if (std::any_of(entity.subdomains.begin(), entity.subdomains.end(),
                      [&](int s) { return std::binary_search(here.begin(), here.end(), s); }))
        mine.push_back(std::move(entity));
  });
  return mine;
}

}  // namespace suture
