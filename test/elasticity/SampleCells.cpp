#include <elasticity/SampleCells.hpp>

namespace sample {

const std::vector<Cell>& cells() {
  static const std::vector<Cell> all{Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9};
  return all;
}

CellBlock straight(Cell cell, const std::vector<std::array<double, 2>>& vertices) {
  std::vector<std::array<double, 2>> nodes = vertices;
  const std::size_t n = vertices.size();
  if (cell != Cell::Triangle3 && cell != Cell::Quadrilateral4)
    for (std::size_t i = 0; i < n; ++i)
      nodes.push_back({0.5 * (vertices[i][0] + vertices[(i + 1) % n][0]), 0.5 * (vertices[i][1] + vertices[(i + 1) % n][1])});
  if (cell == Cell::Quadrilateral9) {
    std::array<double, 2> centre{0, 0};
    for (const auto& v : vertices)
      for (int k = 0; k < 2; ++k) centre[k] += 0.25 * v[k];
    nodes.push_back(centre);
  }
  CellBlock block;
  block.cells = {cell};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    block.connectivity.push_back(static_cast<int>(i));
    block.coordinates.insert(block.coordinates.end(), {nodes[i][0], nodes[i][1]});
  }
  block.offsets = {0, static_cast<int>(nodes.size())};
  return block;
}

CellBlock axisParallel(Cell cell, double a, double b) {
  if (isTriangle(cell)) return straight(cell, {{0, 0}, {a, 0}, {0, b}});
  return straight(cell, {{0, 0}, {a, 0}, {a, b}, {0, b}});
}

CellBlock distorted(Cell cell) {
  if (isTriangle(cell)) return straight(cell, {{0.3, -0.2}, {2.1, 0.4}, {0.7, 1.6}});
  return straight(cell, {{0.3, -0.2}, {2.1, 0.4}, {1.8, 1.9}, {-0.1, 1.2}});
}

CellBlock curved(Cell cell) {
  CellBlock block = distorted(cell);
  const int vertices = isTriangle(cell) ? 3 : 4;
  for (int i = vertices; i < block.nodes(); ++i) {
    block.coordinates[2 * i] += 0.05 * std::sin(3.0 * i);
    block.coordinates[2 * i + 1] += 0.05 * std::cos(2.0 * i);
  }
  return block;
}

double polygonArea(const CellBlock& block, int vertices) {
  double twice = 0;
  for (int i = 0; i < vertices; ++i) {
    const auto p = block.point(i), q = block.point((i + 1) % vertices);
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return 0.5 * twice;
}

}  // namespace sample
