#include <suture/mesh/SideTable.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

std::vector<char> endsOf(const CellBlock& block, const std::vector<Side>& sides) {
  std::vector<char> among(block.nodes(), 0);
  for (const Side& side : sides) {
    const std::vector<int>& ends = cellInfo(block.cells[side.element]).sideNodes[side.side];
    for (const int end : {ends[0], ends[1]}) among[block.nodesOf(side.element)[end]] = 1;
  }
  return among;
}

}  // namespace

SideTable::SideTable(const CellBlock& block, const std::vector<Side>& some) : SideTable(block, endsOf(block, some)) {}

// By counting, not sorting: linear in the number of elements, which stay in ascending order.
SideTable::SideTable(const CellBlock& block, const std::vector<char>& among) : block_(block) {
  std::vector<int> elements;
  for (int e = 0; e < block.elements(); ++e) {
    int count = 0;
    for (const int node : block.nodesOf(e)) count += among[node];
    if (count > 1) elements.push_back(e);
  }
  const auto forEach = [&](const auto& visit) {
    for (const int e : elements)
      forEachSide(block, e, [&](std::pair<int, int> ends, const Side& side) {
        if (among[ends.first] && among[ends.second]) visit(ends, side);
      });
  };
  start_.assign(static_cast<std::size_t>(block.nodes()) + 1, 0);
  forEach([&](std::pair<int, int> ends, const Side&) { ++start_[ends.first + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  forEach([&](std::pair<int, int> ends, const Side& side) { entries_[next[ends.first]++] = {ends.second, side}; });
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
