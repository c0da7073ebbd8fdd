#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

ReferencePoint referencePoint(Cell cell, int node) {
  static const ReferencePoint triangle[] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  static const ReferencePoint square[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  return cellInfo(cell).vertices == 3 ? triangle[node] : square[node];
}

namespace {

// Gradient of shape function i of the linear (bilinear) element at (s, t).
ReferencePoint linearGradient(int vertices, int i, ReferencePoint at) {
  if (vertices == 3) {
    static const ReferencePoint constant[] = {{-1, -1}, {1, 0}, {0, 1}};
    return constant[i];
  }
  const ReferencePoint p = referencePoint(Cell::Quadrilateral4, i);
  return {p[0] * (1 + p[1] * at[1]) / 4, p[1] * (1 + p[0] * at[0]) / 4};
}

ReferencePoint triangle6Gradient(int i, ReferencePoint at) {
  const double l[] = {1 - at[0] - at[1], at[0], at[1]};
  const ReferencePoint g[] = {{-1, -1}, {1, 0}, {0, 1}};
  if (i < 3) return {(4 * l[i] - 1) * g[i][0], (4 * l[i] - 1) * g[i][1]};
  const int a = i - 3, b = (i - 2) % 3;
  return {4 * (l[a] * g[b][0] + l[b] * g[a][0]), 4 * (l[a] * g[b][1] + l[b] * g[a][1])};
}

ReferencePoint serendipityGradient(int i, ReferencePoint at) {
  const ReferencePoint p = referencePoint(Cell::Quadrilateral8, i);
  const double s = at[0], t = at[1];
  if (i < 4) return {p[0] * (1 + p[1] * t) * (2 * p[0] * s + p[1] * t) / 4, p[1] * (1 + p[0] * s) * (2 * p[1] * t + p[0] * s) / 4};
  if (p[0] == 0) return {-s * (1 + p[1] * t), p[1] * (1 - s * s) / 2};
  return {p[0] * (1 - t * t) / 2, -t * (1 + p[0] * s)};
}

// The quadratic through -1, 0, 1 that is one at `node`, and its derivative.
double parabola(double node, double x) { return node == 0 ? 1 - x * x : x * (x + node) / 2; }
double slope(double node, double x) { return node == 0 ? -2 * x : x + node / 2; }

}  // namespace

double shapeFunction(Cell cell, int i, ReferencePoint at) {
  const ReferencePoint p = referencePoint(cell, i);
  const double l[] = {1 - at[0] - at[1], at[0], at[1]};
  switch (cell) {
    case Cell::Triangle3:
      return l[i];
    case Cell::Triangle6:
      return i < 3 ? l[i] * (2 * l[i] - 1) : 4 * l[i - 3] * l[(i - 2) % 3];
    case Cell::Quadrilateral4:
      return (1 + p[0] * at[0]) * (1 + p[1] * at[1]) / 4;
    case Cell::Quadrilateral8:
      if (i < 4) return (1 + p[0] * at[0]) * (1 + p[1] * at[1]) * (p[0] * at[0] + p[1] * at[1] - 1) / 4;
      return p[0] == 0 ? (1 - at[0] * at[0]) * (1 + p[1] * at[1]) / 2 : (1 - at[1] * at[1]) * (1 + p[0] * at[0]) / 2;
    case Cell::Quadrilateral9:
      return parabola(p[0], at[0]) * parabola(p[1], at[1]);
  }
  return 0;
}

ReferencePoint shapeGradient(Cell cell, int i, ReferencePoint at) {
  switch (cell) {
    case Cell::Triangle6:
      return triangle6Gradient(i, at);
    case Cell::Quadrilateral8:
      return serendipityGradient(i, at);
    case Cell::Quadrilateral9: {
      const ReferencePoint p = referencePoint(cell, i);
      return {slope(p[0], at[0]) * parabola(p[1], at[1]), parabola(p[0], at[0]) * slope(p[1], at[1])};
    }
    default:
      return linearGradient(cellInfo(cell).vertices, i, at);
  }
}

}  // namespace suture
