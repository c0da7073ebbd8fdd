#include <suture/mesh/SideTable.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

// By counting, not sorting: linear in the number of elements, which stay in ascending order.
template <typename Wanted>
void SideTable::fill(const std::vector<int>& elements, const Wanted& wanted) {
  start_.assign(static_cast<std::size_t>(block_.nodes()) + 1, 0);
  for (const int e : elements)
    forEachSide(block_, e, [&](std::pair<int, int> ends, const Side&) {
      if (wanted(ends)) ++start_[ends.first + 1];
    });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (const int e : elements)
    forEachSide(block_, e, [&](std::pair<int, int> ends, const Side& side) {
      if (wanted(ends)) entries_[next[ends.first]++] = {ends.second, side};
    });
}

SideTable::SideTable(const CellBlock& block) : block_(block) {
  std::vector<int> elements(block.elements());
  std::iota(elements.begin(), elements.end(), 0);
  fill(elements, [](std::pair<int, int>) { return true; });
}

SideTable::SideTable(const CellBlock& block, const std::vector<Side>& some) : block_(block) {
  std::vector<char> among(block.nodes(), 0);
  for (const Side& side : some) {
    const std::vector<int>& ends = cellInfo(block.cells[side.element]).sideNodes[side.side];
    for (const int end : {ends[0], ends[1]}) among[block.nodesOf(side.element)[end]] = 1;
  }
  std::vector<int> elements;
  for (int e = 0; e < block.elements(); ++e) {
    int count = 0;
    for (const int node : block.nodesOf(e)) count += among[node];
    if (count > 1) elements.push_back(e);
  }
  fill(elements, [&among](std::pair<int, int> ends) { return among[ends.first] && among[ends.second]; });
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
