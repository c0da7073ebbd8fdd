#include <suture/mesh/CellBlock.hpp>

namespace suture {

std::vector<int> CellBlock::nodesOf(const Side& side) const {
  const Span<const int> nodes = nodesOf(side.element);
  const std::vector<int>& local = cellInfo(cells[side.element]).sideNodes[side.side];
  std::vector<int> found;
  found.reserve(local.size());
  for (const int i : local) found.push_back(nodes[i]);
  return found;
}

SideKey CellBlock::keyOf(const Side& side) const {
  const Span<const int> nodes = nodesOf(side.element);
  const CellInfo& cell = cellInfo(cells[side.element]);
  int vertices[kMostSideVertices], count = 0;
  for (const int local : cell.sideNodes[side.side])
    if (local < cell.vertices) vertices[count++] = nodes[local];
  return sideKey(vertices, count);
}

std::map<int, int> nodesUnderCoatings(const CellBlock& block) {
  std::map<int, int> under;
  for (const Coating& coating : block.coatings) {
    const std::vector<int> inner = block.innerNodes(coating);
    const Span<const int> outer = block.outerNodes(coating);
    for (std::size_t i = 0; i < inner.size(); ++i) under[outer[i]] = inner[i];
  }
  return under;
}

CoatedBlock::CoatedBlock(const CellBlock& block) : given_(block) {
  if (block.coatings.empty()) return;
  copy_ = block;
  for (const Coating& coating : block.coatings) {
    const std::vector<int> inner = block.innerNodes(coating);
    const Span<const int> outer = block.outerNodes(coating);
    copy_.cells.push_back(block.cells[coating.element]);
    copy_.connectivity.insert(copy_.connectivity.end(), inner.begin(), inner.end());
    copy_.connectivity.insert(copy_.connectivity.end(), outer.begin(), outer.end());
    copy_.offsets.push_back(static_cast<int>(copy_.connectivity.size()));
  }
}

}  // namespace suture
