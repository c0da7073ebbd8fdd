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

}  // namespace suture
