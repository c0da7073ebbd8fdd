#include <suture/base/Point.hpp>
#include <suture/mesh/SplitCell.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kEqualDiagonals = 1e-9;  // relative difference of lengths that counts as none

int firstOf(const Span<const int>& nodes, const std::vector<int>& locals, const NodeOrder& isBefore) {
  return *std::min_element(locals.begin(), locals.end(), [&](int a, int b) { return isBefore(nodes[a], nodes[b]); });
}

std::vector<int> verticesOf(const std::vector<int>& side, const CellInfo& cell) {
  std::vector<int> vertices;
  for (const int local : side)
    if (local < cell.vertices) vertices.push_back(local);
  return vertices;
}

std::vector<CellSimplex> splitQuadrilateral(const CellBlock& block, const Span<const int>& nodes, const NodeOrder& isBefore) {
  const double one = norm(minus(block.point(nodes[2]), block.point(nodes[0])));
  const double other = norm(minus(block.point(nodes[3]), block.point(nodes[1])));
  const bool equal = std::abs(one - other) <= kEqualDiagonals * one;
  const bool even = equal ? firstOf(nodes, {0, 1, 2, 3}, isBefore) % 2 == 0 : one < other;
  if (even) return {{0, 1, 2, -1}, {0, 2, 3, -1}};
  return {{0, 1, 3, -1}, {1, 2, 3, -1}};
}

}  // namespace

std::vector<CellSimplex> splitCell(const CellBlock& block, int element, const NodeOrder& isBefore) {
  const CellInfo& cell = cellInfo(block.cells[element]);
  const Span<const int> nodes = block.nodesOf(element);
  if (isSimplex(block.cells[element])) return {{0, 1, 2, cell.dimension == 3 ? 3 : -1}};
  if (cell.dimension == 2) return splitQuadrilateral(block, nodes, isBefore);
  std::vector<int> all(std::size_t(cell.vertices));
  for (int i = 0; i < cell.vertices; ++i) all[i] = i;
  const int first = firstOf(nodes, all, isBefore);
  std::vector<CellSimplex> found;
  for (const std::vector<int>& side : cell.sideNodes) {
    const std::vector<int> corners = verticesOf(side, cell);
    if (std::find(corners.begin(), corners.end(), first) != corners.end()) continue;
    const int count = static_cast<int>(corners.size());
    const int apex = count == 3 ? corners[0] : firstOf(nodes, corners, isBefore);
    const int at = static_cast<int>(std::find(corners.begin(), corners.end(), apex) - corners.begin());
    for (int k = 1; k + 1 < count; ++k) found.push_back({apex, corners[(at + k + 1) % count], corners[(at + k) % count], first});
  }
  return found;
}

int middleOf(Cell type, int i, int j) {
  const CellInfo& cell = cellInfo(type);
  if (cell.order == 1) return -1;
  for (std::size_t k = 0; k < cell.edges.size(); ++k)
    if (std::minmax(cell.edges[k][0], cell.edges[k][1]) == std::minmax(i, j)) return cell.vertices + static_cast<int>(k);
  if (type == Cell::Quadrilateral9) return 8;
  if (type != Cell::Hexahedron27) return -1;
  const int ends[2] = {i, j};
  const int side = sideThrough(cell, ends, 2);
  return side >= 0 ? cell.sideNodes[side].back() : cell.nodes - 1;
}

int sideThrough(const CellInfo& cell, const int* locals, int count) {
  for (std::size_t s = 0; s < cell.sideNodes.size(); ++s) {
    const std::vector<int>& side = cell.sideNodes[s];
    if (std::all_of(locals, locals + count, [&](int local) { return std::find(side.begin(), side.end(), local) != side.end(); }))
      return static_cast<int>(s);
  }
  return -1;
}

}  // namespace suture
