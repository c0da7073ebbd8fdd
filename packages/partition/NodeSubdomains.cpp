#include <numeric>
#include <suture/partition/NodeSubdomains.hpp>

namespace suture {

NodeSubdomains nodeSubdomains(const CellBlock& block, const std::vector<int>& subdomainOfElement, int subdomains) {
  // Elements by subdomain, so that every row comes out ascending.
  std::vector<int> start(subdomains + 1, 0), order(block.elements());
  for (int s : subdomainOfElement) ++start[s + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int e = 0; e < block.elements(); ++e) order[next[subdomainOfElement[e]]++] = e;

  const auto forEachHolding = [&](const auto& visit) {
    std::vector<int> last(block.nodes(), -1);
    for (int e : order)
      for (int node : block.nodesOf(e))
        if (last[node] != subdomainOfElement[e]) {
          last[node] = subdomainOfElement[e];
          visit(node, subdomainOfElement[e]);
        }
  };
  NodeSubdomains found;
  found.offsets.assign(block.nodes() + 1, 0);
  forEachHolding([&](int node, int) { ++found.offsets[node + 1]; });
  std::partial_sum(found.offsets.begin(), found.offsets.end(), found.offsets.begin());
  found.subdomains.resize(found.offsets.back());
  std::vector<int> fill(found.offsets.begin(), found.offsets.end() - 1);
  forEachHolding([&](int node, int subdomain) { found.subdomains[fill[node]++] = subdomain; });
  return found;
}

}  // namespace suture
