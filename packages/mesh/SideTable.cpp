#include <suture/mesh/SideTable.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

template <typename Visit>
void forEachSide(const CellBlock& block, const Visit& visit) {
  for (int e = 0; e < block.elements(); ++e) {
    const Span<const int> nodes = block.nodesOf(e);
    const auto& sides = cellInfo(block.cells[e]).sideNodes;
    for (int s = 0; s < static_cast<int>(sides.size()); ++s) visit(std::minmax(nodes[sides[s][0]], nodes[sides[s][1]]), Side{e, s});
  }
}

}  // namespace

// By counting, not sorting: linear in the size of the mesh, and elements stay in ascending order.
SideTable::SideTable(const CellBlock& block) : block_(block), start_(static_cast<std::size_t>(block.nodes()) + 1, 0) {
  forEachSide(block, [&](std::pair<int, int> ends, const Side&) { ++start_[ends.first + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  forEachSide(block, [&](std::pair<int, int> ends, const Side& side) { entries_[next[ends.first]++] = {ends.second, side}; });
}

std::vector<Side> SideTable::between(int a, int b) const {
  const auto [low, high] = std::minmax(a, b);
  std::vector<Side> found;
  for (int k = start_[low]; k < start_[low + 1]; ++k)
    if (entries_[k].high == high) found.push_back(entries_[k].side);
  return found;
}

bool SideTable::onBoundary(const Side& side) const {
  const std::vector<int> nodes = block_.nodesOf(side);
  return between(nodes[0], nodes[1]).size() == 1;
}

}  // namespace suture
