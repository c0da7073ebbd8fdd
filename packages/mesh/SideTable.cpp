#include <suture/mesh/SideTable.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

std::vector<char> verticesOf(const CellBlock& block, const std::vector<Side>& sides) {
  std::vector<char> among(block.nodes(), 0);
  for (const Side& side : sides) {
    const CellInfo& cell = cellInfo(block.cells[side.element]);
    for (const int local : cell.sideNodes[side.side])
      if (local < cell.vertices) among[block.nodesOf(side.element)[local]] = 1;
  }
  return among;
}

}  // namespace

SideTable::SideTable(const CellBlock& block, const std::vector<Side>& some) : SideTable(block, verticesOf(block, some)) {}

// Counting instead of sorting: linear in the number of elements, which stay in ascending order.
SideTable::SideTable(const CellBlock& block, const std::vector<char>& among) : block_(block) {
  std::vector<int> elements;
  for (int e = 0; e < block.elements(); ++e) {
    int count = 0;
    for (const int node : block.nodesOf(e)) count += among[node];
    if (count > 1) elements.push_back(e);
  }
  const auto forEach = [&](const auto& visit) {
    for (const int e : elements) {
      const CellInfo& cell = cellInfo(block.cells[e]);
      const Span<const int> nodes = block.nodesOf(e);
      forEachSide(block, e, [&](const SideKey& key, const Side& side) {
        for (const int local : cell.sideNodes[side.side])
          if (local < cell.vertices && !among[nodes[local]]) return;
        visit(key, side);
      });
    }
  };
  start_.assign(static_cast<std::size_t>(block.nodes()) + 1, 0);
  forEach([&](const SideKey& key, const Side&) { ++start_[key.low + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  forEach([&](const SideKey& key, const Side& side) { entries_[next[key.low]++] = {key.rest, side}; });
}

std::vector<Side> SideTable::of(const SideKey& key) const {
  std::vector<Side> found;
  for (int k = start_[key.low]; k < start_[key.low + 1]; ++k)
    if (entries_[k].rest == key.rest) found.push_back(entries_[k].side);
  return found;
}

bool SideTable::onBoundary(const Side& side) const { return of(block_.keyOf(side)).size() == 1; }

}  // namespace suture
