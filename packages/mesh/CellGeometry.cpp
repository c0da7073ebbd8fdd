#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

double jacobianAt(const CellBlock& block, int element, ReferencePoint at) {
  const Cell cell = block.cells[element];
  const Span<const int> nodes = block.nodesOf(element);
  double xs = 0, xt = 0, ys = 0, yt = 0;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const ReferencePoint g = shapeGradient(cell, i, at);
    const Point x = block.point(nodes[i]);
    xs += g[0] * x[0], xt += g[1] * x[0], ys += g[0] * x[1], yt += g[1] * x[1];
  }
  return xs * yt - xt * ys;
}

// The determinant of a Triangle6 is a quadratic polynomial: it is least at a vertex, where it is stationary on a side, or where it is
// inside.
double leastOnTriangle(const CellBlock& block, int element, ReferencePoint& where) {
  double v[6];
  for (int k = 0; k < 6; ++k) v[k] = jacobianAt(block, element, referencePoint(Cell::Triangle6, k));
  // c0 + cs s + ct t + css s^2 + cst s t + ctt t^2 through the six nodes
  const double cs = 4 * v[3] - 3 * v[0] - v[1], ct = 4 * v[5] - 3 * v[0] - v[2];
  const double css = 2 * (v[0] + v[1] - 2 * v[3]), ctt = 2 * (v[0] + v[2] - 2 * v[5]), cst = 4 * (v[0] + v[4] - v[3] - v[5]);
  const auto value = [&](ReferencePoint p) {
    return v[0] + cs * p[0] + ct * p[1] + css * p[0] * p[0] + cst * p[0] * p[1] + ctt * p[1] * p[1];
  };
  double least = v[0];
  where = {0, 0};
  const auto consider = [&](ReferencePoint p, double at) {
    if (at < least) least = at, where = p;
  };
  for (int k = 1; k < 6; ++k) consider(referencePoint(Cell::Triangle6, k), v[k]);
  for (int side = 0; side < 3; ++side) {  // a + b x + c x^2 from vertex to vertex, the middle of the side at x = 1/2
    const int from = side, to = (side + 1) % 3;
    const double b = 4 * v[3 + side] - 3 * v[from] - v[to], c = 2 * (v[from] + v[to] - 2 * v[3 + side]);
    const double x = -b / (2 * c);
    if (!(c > 0 && x > 0 && x < 1)) continue;
    const ReferencePoint p = referencePoint(Cell::Triangle6, from), q = referencePoint(Cell::Triangle6, to);
    consider({p[0] + x * (q[0] - p[0]), p[1] + x * (q[1] - p[1])}, v[from] + b * x / 2);
  }
  const double hessian = 4 * css * ctt - cst * cst;
  if (hessian > 0 && css > 0) {
    const ReferencePoint p{(cst * ct - 2 * ctt * cs) / hessian, (cst * cs - 2 * css * ct) / hessian};
    if (p[0] > 0 && p[1] > 0 && p[0] + p[1] < 1) consider(p, value(p));
  }
  return least;
}

// The determinant of a quadratic quadrilateral is cubic in each direction. In Bernstein's form its values lie between the least and the
// largest coefficient, and coefficients at the corners are values; halving brings the two together (Johnen, Remacle, Geuzaine, J. Comput.
// Phys. 2013).
using Cubic = std::array<std::array<double, 4>, 4>;

void leastOfCubic(const Cubic& c, ReferencePoint low, ReferencePoint high, int depth, double& least, ReferencePoint& where) {
  double bound = c[0][0], size = 0;
  for (const auto& row : c)
    for (const double value : row) bound = std::min(bound, value), size = std::max(size, std::abs(value));
  for (int i : {0, 3})
    for (int j : {0, 3})
      if (c[i][j] < least) least = c[i][j], where = {i == 0 ? low[0] : high[0], j == 0 ? low[1] : high[1]};
  if (depth == 0 || bound >= least - 1e-3 * size) return;
  const auto halves = [](std::array<double, 4> a, std::array<double, 4>& left, std::array<double, 4>& right) {  // de Casteljau
    for (int k = 0; k < 4; ++k) {
      left[k] = a[0];
      right[3 - k] = a[3 - k];
      for (int i = 0; i < 3 - k; ++i) a[i] = (a[i] + a[i + 1]) / 2;
    }
  };
  Cubic inS[2];
  for (int j = 0; j < 4; ++j) {
    std::array<double, 4> column, left, right;
    for (int i = 0; i < 4; ++i) column[i] = c[i][j];
    halves(column, left, right);
    for (int i = 0; i < 4; ++i) inS[0][i][j] = left[i], inS[1][i][j] = right[i];
  }
  const ReferencePoint middle{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
  for (int s = 0; s < 2; ++s) {
    Cubic inT[2];
    for (int i = 0; i < 4; ++i) halves(inS[s][i], inT[0][i], inT[1][i]);
    for (int t = 0; t < 2; ++t)
      leastOfCubic(inT[t], {s ? middle[0] : low[0], t ? middle[1] : low[1]}, {s ? high[0] : middle[0], t ? high[1] : middle[1]}, depth - 1,
                   least, where);
  }
}

double leastOnSquare(const CellBlock& block, int element, ReferencePoint& where) {
  // Bernstein coefficients of the cubic through values at -1, -1/3, 1/3, 1.
  static const double toBernstein[4][4] = {{1, 0, 0, 0}, {-5. / 6, 3, -1.5, 1. / 3}, {1. / 3, -1.5, 3, -5. / 6}, {0, 0, 0, 1}};
  double values[4][4];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) values[i][j] = jacobianAt(block, element, {-1 + 2 * i / 3.0, -1 + 2 * j / 3.0});
  Cubic c{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l) c[i][j] += toBernstein[i][k] * toBernstein[j][l] * values[k][l];
  double least = c[0][0];
  where = {-1, -1};
  leastOfCubic(c, {-1, -1}, {1, 1}, 6, least, where);
  return least;
}

}  // namespace

double smallestJacobian(const CellBlock& block, int element, Point* place) {
  const Cell cell = block.cells[element];
  double least = 0;
  ReferencePoint where{0, 0};
  if (cell == Cell::Triangle3) {
    least = 2 * signedArea(block, element);  // everywhere
  } else if (cell == Cell::Triangle6) {
    least = leastOnTriangle(block, element, where);
  } else if (cell == Cell::Quadrilateral8 || cell == Cell::Quadrilateral9) {
    least = leastOnSquare(block, element, where);
  } else {  // linear in each direction: least at a vertex
    least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k)
      if (const double value = jacobianAt(block, element, referencePoint(cell, k)); value < least)
        least = value, where = referencePoint(cell, k);
  }
  if (place) {
    *place = {0, 0, 0};
    const Span<const int> nodes = block.nodesOf(element);
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
      for (int k = 0; k < block.dimension; ++k) (*place)[k] += shapeFunction(cell, i, where) * block.point(nodes[i])[k];
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
