#include <elasticity/SampleCells.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

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

const std::vector<Cell>& solids() {
  static const std::vector<Cell> all{Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron20,
                                     Cell::Hexahedron27, Cell::Wedge6,        Cell::Pyramid5};
  return all;
}

CellBlock mapped(Cell cell, const std::function<suture::Point(const suture::Point&)>& map) {
  CellBlock block;
  block.dimension = 3;
  block.cells = {cell};
  const int nodes = suture::cellInfo(cell).nodes;
  for (int i = 0; i < nodes; ++i) {
    block.connectivity.push_back(i);
    const suture::Point p = map(suture::referencePoint(cell, i));
    block.coordinates.insert(block.coordinates.end(), p.begin(), p.end());
  }
  block.offsets = {0, nodes};
  return block;
}

CellBlock brick(Cell cell, double a, double b, double c) {
  const bool simplex = suture::isSimplex(cell), wedge = cell == Cell::Wedge6, pyramid = cell == Cell::Pyramid5;
  return mapped(cell, [&](const suture::Point& p) -> suture::Point {
    if (simplex) return {a * p[0], b * p[1], c * p[2]};
    if (wedge) return {a * p[0], b * p[1], c * (1 + p[2]) / 2};
    return {a * (1 + p[0]) / 2, b * (1 + p[1]) / 2, pyramid ? c * p[2] : c * (1 + p[2]) / 2};
  });
}

CellBlock distortedSolid(Cell cell) {
  const double bend = suture::isSimplex(cell) ? 0.0 : 1.0;  // products keep the edges of the other cells straight
  return mapped(cell, [bend](const suture::Point& p) -> suture::Point {
    const double x = p[0], y = p[1], z = p[2], xy = 0.1 * bend * x * y, yz = 0.12 * bend * y * z, xz = -0.08 * bend * x * z;
    return {0.3 + 1.1 * x + 0.2 * y - 0.1 * z + xy + yz, -0.2 - 0.15 * x + 0.9 * y + 0.25 * z - yz + xz,
            0.1 + 0.3 * x - 0.2 * y + 1.2 * z + xy - xz};
  });
}

CellBlock curvedSolid(Cell cell) {
  CellBlock block = distortedSolid(cell);
  for (int i = suture::cellInfo(cell).vertices; i < block.nodes(); ++i)
    for (int k = 0; k < 3; ++k) block.coordinates[3 * i + k] += 0.04 * std::sin(3.0 * i + 2.0 * k);
  return block;
}

std::vector<suture::Side> sidesOfElement(const CellBlock& block) {
  std::vector<suture::Side> sides;
  for (std::size_t s = 0; s < suture::cellInfo(block.cells[0]).sideNodes.size(); ++s) sides.push_back({0, static_cast<int>(s)});
  return sides;
}

}  // namespace sample
