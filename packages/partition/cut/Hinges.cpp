#include <map>
#include <set>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/cut/Hinges.hpp>

namespace suture {

void findHinges(const CellBlock& block, const std::vector<int>& bodyOfElement, const std::vector<std::string>& bodies,
                const Components& parts, Problems& problems) {
  std::set<int> here;
  for (const std::vector<int>& elements : parts.elements) here.insert(bodyOfElement[elements.front()]);
  if (parts.count() == static_cast<int>(here.size())) return;
  struct Found {
    std::set<int> nodes, parts;
  };
  std::map<int, Found> hinges;  // by body
  std::vector<int> partOfNode(block.nodes(), -1);
  for (int e = 0; e < block.elements(); ++e)
    for (int node : block.nodesOf(e)) {
      const int before = partOfNode[node] < 0 ? parts.of[e] : partOfNode[node];
      partOfNode[node] = before;
      if (before == parts.of[e]) continue;
      Found& found = hinges[bodyOfElement[e]];
      found.nodes.insert(node);
      found.parts.insert({before, parts.of[e]});
    }
  for (const auto& [body, found] : hinges) {
    std::string places;
    std::size_t told = 0;
    for (auto node = found.nodes.begin(); node != found.nodes.end() && told < 3; ++node, ++told)
      places += (told > 0 ? ", " : "") + placeText(block.point(*node), block.dimension);
    if (found.nodes.size() > told) places += ", ...";
    problems.add("Bodies/" + bodies[body],
                 std::to_string(found.parts.size()) + " parts of this body are connected only by " +
                     (found.nodes.size() == 1 ? "a single node" : std::to_string(found.nodes.size()) + " single nodes") + " (" + places +
                     "): a hinge, about which they can rotate. Connect them by a common element side, or make them separate bodies");
  }
}

}  // namespace suture
