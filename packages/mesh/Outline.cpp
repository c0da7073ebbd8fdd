#include <suture/mesh/Outline.hpp>
#include <suture/mesh/SideTable.hpp>

#include <cstdint>

namespace suture {

namespace {

/// Pseudo-random numbers for the nodes (the mixing function of splitmix64).
std::vector<std::uint64_t> numbersOf(int nodes) {
  std::vector<std::uint64_t> numbers(nodes);
  for (int node = 0; node < nodes; ++node) {
    std::uint64_t x = (static_cast<std::uint64_t>(node) + 1) * 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    numbers[node] = x ^ (x >> 31);
  }
  return numbers;
}

/// Value for the two neighbours of a vertex along a side; changes sign if they are swapped.
std::uint64_t oriented(std::uint64_t next, std::uint64_t last) { return next * (last >> 7) - last * (next >> 7); }

/// Sums over the sides at each node. Two elements traverse their common side in opposite senses, so its terms cancel.
std::vector<std::uint64_t> signedSums(const CellBlock& block) {
  const std::vector<std::uint64_t> number = numbersOf(block.nodes());
  std::vector<std::uint64_t> sums(block.nodes(), 0);
  for (int element = 0; element < block.elements(); ++element) {
    const Span<const int> nodes = block.nodesOf(element);
    const CellInfo& cell = cellInfo(block.cells[element]);
    for (const std::vector<int>& side : cell.sideNodes) {
      if (block.dimension == 2) {
        const int a = nodes[side[0]], b = nodes[side[1]];
        sums[a] += number[b];
        sums[b] -= number[a];
        continue;
      }
      int count = 0;
      while (count < static_cast<int>(side.size()) && side[count] < cell.vertices) ++count;
      for (int k = 0; k < count; ++k)
        sums[nodes[side[k]]] += oriented(number[nodes[side[(k + 1) % count]]], number[nodes[side[(k + count - 1) % count]]]);
    }
  }
  return sums;
}

}  // namespace

std::vector<Side> outline(const CellBlock& block) {
  std::vector<char> outside(block.nodes());
  const std::vector<std::uint64_t> sums = signedSums(block);
  for (int node = 0; node < block.nodes(); ++node) outside[node] = sums[node] != 0;
  const SideTable table(block, outside);
  std::vector<Side> sides;
  for (int element = 0; element < block.elements(); ++element) {
    const Span<const int> nodes = block.nodesOf(element);
    int count = 0;
    for (const int node : nodes) count += outside[node];
    if (count < 2) continue;
    const CellInfo& cell = cellInfo(block.cells[element]);
    forEachSide(block, element, [&](const SideKey& key, const Side& side) {
      for (const int local : cell.sideNodes[side.side])
        if (local < cell.vertices && !outside[nodes[local]]) return;
      if (table.of(key).size() == 1) sides.push_back(side);
    });
  }
  return sides;
}

}  // namespace suture
