#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

using Reference = std::array<double, 2>;

// Reference coordinates of the nodes: triangles on (0,0), (1,0), (0,1), quadrilaterals on [-1,1]^2.
Reference referencePoint(Cell cell, int node) {
  static const Reference triangle[] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  static const Reference square[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  return cellInfo(cell).vertices == 3 ? triangle[node] : square[node];
}

// Gradient of shape function i of the linear (bilinear) element at (s, t).
Reference linearGradient(int vertices, int i, Reference at) {
  if (vertices == 3) {
    static const Reference constant[] = {{-1, -1}, {1, 0}, {0, 1}};
    return constant[i];
  }
  const Reference p = referencePoint(Cell::Quadrilateral4, i);
  return {p[0] * (1 + p[1] * at[1]) / 4, p[1] * (1 + p[0] * at[0]) / 4};
}

Reference triangle6Gradient(int i, Reference at) {
  const double l[] = {1 - at[0] - at[1], at[0], at[1]};
  const Reference g[] = {{-1, -1}, {1, 0}, {0, 1}};
  if (i < 3) return {(4 * l[i] - 1) * g[i][0], (4 * l[i] - 1) * g[i][1]};
  const int a = i - 3, b = (i - 2) % 3;
  return {4 * (l[a] * g[b][0] + l[b] * g[a][0]), 4 * (l[a] * g[b][1] + l[b] * g[a][1])};
}

Reference serendipityGradient(int i, Reference at) {
  const Reference p = referencePoint(Cell::Quadrilateral8, i);
  const double s = at[0], t = at[1];
  if (i < 4) return {p[0] * (1 + p[1] * t) * (2 * p[0] * s + p[1] * t) / 4, p[1] * (1 + p[0] * s) * (2 * p[1] * t + p[0] * s) / 4};
  if (p[0] == 0) return {-s * (1 + p[1] * t), p[1] * (1 - s * s) / 2};
  return {p[0] * (1 - t * t) / 2, -t * (1 + p[0] * s)};
}

// The quadratic through -1, 0, 1 that is one at `node`, and its derivative.
double parabola(double node, double x) { return node == 0 ? 1 - x * x : x * (x + node) / 2; }
double slope(double node, double x) { return node == 0 ? -2 * x : x + node / 2; }

Reference gradient(Cell cell, int i, Reference at) {
  switch (cell) {
    case Cell::Triangle6:
      return triangle6Gradient(i, at);
    case Cell::Quadrilateral8:
      return serendipityGradient(i, at);
    case Cell::Quadrilateral9: {
      const Reference p = referencePoint(cell, i);
      return {slope(p[0], at[0]) * parabola(p[1], at[1]), parabola(p[0], at[0]) * slope(p[1], at[1])};
    }
    default:
      return linearGradient(cellInfo(cell).vertices, i, at);
  }
}

}  // namespace

double smallestJacobian(const CellBlock& block, int element) {
  const Cell cell = block.cells[element];
  const Span<const int> nodes = block.nodesOf(element);
  const int count = static_cast<int>(nodes.size());
  double least = std::numeric_limits<double>::infinity();
  const int places = cell == Cell::Triangle3 ? 1 : count;  // the map of a straight triangle is the same everywhere
  for (int k = 0; k < places; ++k) {
    const Reference at = referencePoint(cell, k);
    double xs = 0, xt = 0, ys = 0, yt = 0;
    for (int i = 0; i < count; ++i) {
      const Reference g = gradient(cell, i, at);
      const Point x = block.point(nodes[i]);
      xs += g[0] * x[0], xt += g[1] * x[0], ys += g[0] * x[1], yt += g[1] * x[1];
    }
    least = std::min(least, xs * yt - xt * ys);
  }
  return least;
}

double signedArea(const CellBlock& block, int element) {
  const Span<const int> nodes = block.nodesOf(element);
  const int vertices = cellInfo(block.cells[element]).vertices;
  const Point o = block.point(nodes[0]);  // areas about a vertex of the element itself: no cancellation far from the origin
  double twice = 0;
  for (int i = 1; i + 1 < vertices; ++i) {
    const Point a = block.point(nodes[i]), b = block.point(nodes[i + 1]);
    twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
  }
  return twice / 2;
}

Point centreOf(const CellBlock& block, int element) {
  const Span<const int> nodes = block.nodesOf(element);
  const int vertices = cellInfo(block.cells[element]).vertices;
  Point centre{0, 0, 0};
  for (int i = 0; i < vertices; ++i) {
    const Point p = block.point(nodes[i]);
    for (int k = 0; k < 3; ++k) centre[k] += p[k] / vertices;
  }
  return centre;
}

double diameterOf(const CellBlock& block, int element) {
  const Span<const int> nodes = block.nodesOf(element);
  const int vertices = cellInfo(block.cells[element]).vertices;
  double square = 0;
  for (int i = 0; i < vertices; ++i)
    for (int j = 0; j < i; ++j) {
      const Point a = block.point(nodes[i]), b = block.point(nodes[j]);
      const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
      square = std::max(square, x * x + y * y + z * z);
    }
  return std::sqrt(square);
}

std::string placeText(const Point& point, int dimension) {
  char text[120];
  if (dimension == 3)
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", point[0], point[1], point[2]);
  else
    std::snprintf(text, sizeof text, "(%.6g, %.6g)", point[0], point[1]);
  return text;
}

std::string countAt(std::size_t count, const std::string& what, const std::string& place) {
  return std::to_string(count) + " " + what + (count == 1 ? " (at " : "s (the first at ") + place + ")";
}

}  // namespace suture
