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
template <typename Wanted>
void SideTable::fill(const Wanted& wanted) {
  start_.assign(static_cast<std::size_t>(block_.nodes()) + 1, 0);
  forEachSide(block_, [&](std::pair<int, int> ends, const Side&) {
    if (wanted(ends)) ++start_[ends.first + 1];
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  forEachSide(block_, [&](std::pair<int, int> ends, const Side& side) {
    if (wanted(ends)) entries_[next[ends.first]++] = {ends.second, side};
  });
}

SideTable::SideTable(const CellBlock& block) : block_(block) {
  fill([](std::pair<int, int>) { return true; });
}

SideTable::SideTable(const CellBlock& block, const std::vector<Side>& some) : block_(block) {
  std::vector<char> among(block.nodes(), 0);
  for (const Side& side : some) {
    const std::vector<int>& ends = cellInfo(block.cells[side.element]).sideNodes[side.side];
    for (const int end : {ends[0], ends[1]}) among[block.nodesOf(side.element)[end]] = 1;
  }
  fill([&among](std::pair<int, int> ends) { return among[ends.first] && among[ends.second]; });
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
