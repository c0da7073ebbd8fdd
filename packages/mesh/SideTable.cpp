#include <suture/mesh/SideTable.hpp>

#include <algorithm>
#include <tuple>

namespace suture {

SideTable::SideTable(const CellBlock& block) : block_(block) {
  for (int e = 0; e < block.elements(); ++e) {
    const int sides = static_cast<int>(cellInfo(block.cells[e]).sideNodes.size());
    for (int s = 0; s < sides; ++s) {
      const std::vector<int> nodes = block.nodesOf(Side{e, s});
      entries_.push_back({std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1]), {e, s}});
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& x, const Entry& y) {
    return std::tie(x.low, x.high, x.side.element, x.side.side) < std::tie(y.low, y.high, y.side.element, y.side.side);
  });
}

std::vector<Side> SideTable::between(int a, int b) const {
  const std::pair<int, int> ends{std::min(a, b), std::max(a, b)};
  auto at = std::lower_bound(entries_.begin(), entries_.end(), ends, [](const Entry& x, const std::pair<int, int>& y) {
    return std::tie(x.low, x.high) < std::tie(y.first, y.second);
  });
  std::vector<Side> found;
  for (; at != entries_.end() && at->low == ends.first && at->high == ends.second; ++at) found.push_back(at->side);
  return found;
}

bool SideTable::onBoundary(const Side& side) const {
  const std::vector<int> nodes = block_.nodesOf(side);
  return between(nodes[0], nodes[1]).size() == 1;
}

}  // namespace suture
