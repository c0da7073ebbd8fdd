#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/JacobianBound.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

double smallestJacobian(const CellBlock& block, int element, Point* place) {
  ReferencePoint where{0, 0, 0};
  const double least = leastJacobian(block, element, where);
  if (place) {
    *place = {0, 0, 0};
    const Span<const int> nodes = block.nodesOf(element);
    ShapeJet jets[kMostCellNodes];
    shapeJets(block.cells[element], where, jets);
    for (std::size_t i = 0; i < nodes.size(); ++i) *place = plus(*place, scaled(jets[i].value, block.point(nodes[i])));
  }
  return least;
}

namespace {

/// Six times the volume of the cone from a point to a side; the side is split into triangles about its centre.
double coneOver(const CellBlock& block, const Side& side, const Point& from) {
  const CellInfo& cell = cellInfo(block.cells[side.element]);
  std::vector<Point> corners;
  Point centre{0, 0, 0};
  for (const int local : cell.sideNodes[side.side])
    if (local < cell.vertices) corners.push_back(minus(block.point(block.nodesOf(side.element)[local]), from));
  for (const Point& p : corners) centre = plus(centre, scaled(1.0 / static_cast<double>(corners.size()), p));
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) sum += dot(centre, cross(corners[k], corners[(k + 1) % corners.size()]));
  return sum;
}

}  // namespace

double signedSize(const CellBlock& block, int element) {
  const Span<const int> nodes = block.nodesOf(element);
  const Point o = block.point(nodes[0]);  // relative to a vertex of the element: avoids cancellation far from the origin
  double sum = 0;
  if (block.dimension == 3) {
    const int sides = static_cast<int>(cellInfo(block.cells[element]).sideNodes.size());
    for (int side = 0; side < sides; ++side) sum += coneOver(block, {element, side}, o);
    return sum / 6;
  }
  const int vertices = cellInfo(block.cells[element]).vertices;
  for (int i = 1; i + 1 < vertices; ++i) sum += cross(minus(block.point(nodes[i]), o), minus(block.point(nodes[i + 1]), o))[2];
  return sum / 2;
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

std::string countAt(std::size_t count, const std::string& what, const std::string& place, const std::string& more) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + more + (count == 1 ? " (at " : " (the first at ") + place + ")";
}

}  // namespace suture
