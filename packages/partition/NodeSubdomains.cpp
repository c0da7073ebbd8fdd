#include <algorithm>
#include <suture/partition/NodeSubdomains.hpp>
#include <utility>

namespace suture {

// Most nodes are in one subdomain: lists are made only for the others, and elements are visited in memory order.
NodeSubdomains nodeSubdomains(const CellBlock& block, const std::vector<int>& subdomainOfElement) {
  constexpr int none = -1, several = -2;
  std::vector<int> only(block.nodes(), none);
  const auto forEachPlace = [&](const auto& visit) {
    for (int e = 0; e < block.elements(); ++e)
      for (const int node : block.nodesOf(e)) visit(node, subdomainOfElement[e]);
    for (const Coating& coating : block.coatings)
      for (const int node : block.outerNodes(coating)) visit(node, subdomainOfElement[coating.element]);
  };
  forEachPlace([&](int node, int subdomain) {
    int& known = only[node];
    known = known == none || known == subdomain ? subdomain : several;
  });
  std::vector<std::pair<int, int>> shared;
  forEachPlace([&](int node, int subdomain) {
    if (only[node] == several) shared.emplace_back(node, subdomain);
  });
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

  NodeSubdomains found;
  found.offsets.reserve(static_cast<std::size_t>(block.nodes()) + 1);
  found.subdomains.reserve(static_cast<std::size_t>(block.nodes()) + shared.size());
  auto next = shared.begin();
  for (int node = 0; node < block.nodes(); ++node) {
    if (only[node] >= 0) found.subdomains.push_back(only[node]);
    for (; next != shared.end() && next->first == node; ++next) found.subdomains.push_back(next->second);
    found.offsets.push_back(static_cast<int>(found.subdomains.size()));
  }
  return found;
}

}  // namespace suture
