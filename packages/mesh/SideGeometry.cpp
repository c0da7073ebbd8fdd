#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/GaussRule.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <cmath>

namespace suture {

namespace {

constexpr int kPoints = 4;  // Gauss points per direction of a 3D side

[[noreturn]] void noSuchSide(int nodes, int dimension) {
  throw InternalError("a side of " + std::to_string(nodes) + " nodes in " + std::to_string(dimension) + " dimensions");
}

}  // namespace

Cell sideCell(int nodes) {
  switch (nodes) {
    case 3:
      return Cell::Triangle3;
    case 4:
      return Cell::Quadrilateral4;
    case 6:
      return Cell::Triangle6;
    case 8:
      return Cell::Quadrilateral8;
    case 9:
      return Cell::Quadrilateral9;
  }
  noSuchSide(nodes, 3);
}

namespace {

std::vector<NodeNormal> nodeNormalsInPlane(const std::vector<Point>& points) {
  const int nodes = static_cast<int>(points.size());
  const std::vector<double> weights = nodes == 2 ? std::vector<double>{1, 1} : std::vector<double>{1.0 / 3, 1.0 / 3, 4.0 / 3};
  constexpr double places[] = {-1, 1, 0};
  std::vector<NodeNormal> normals;
  for (int i = 0; i < nodes; ++i) {
    const SideShape shape = sideShape(nodes, places[i]);
    Point tangent{0, 0, 0};
    for (int a = 0; a < nodes; ++a) tangent = plus(tangent, scaled(shape.slope[a], points[a]));
    normals.push_back({{tangent[1], -tangent[0], 0}, weights[i]});
  }
  return normals;
}

/// Cross product of the derivatives of the position by the two reference coordinates. \param jets  shape functions at the point
Point density(const std::vector<Point>& points, const ShapeJet* jets) {
  Point s{0, 0, 0}, t{0, 0, 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    s = plus(s, scaled(jets[i].gradient[0], points[i]));
    t = plus(t, scaled(jets[i].gradient[1], points[i]));
  }
  return cross(s, t);
}

double weightInSpace(Cell cell, int node) {
  switch (cell) {
    case Cell::Triangle3:
      return 1.0 / 6;
    case Cell::Triangle6:
      return 1.0 / 12;
    case Cell::Quadrilateral4:
      return 1.0;
    case Cell::Quadrilateral8:
      return 0.5;
    case Cell::Quadrilateral9: {  // Simpson's rule in both directions
      const ReferencePoint p = referencePoint(cell, node);
      return (p[0] == 0 ? 4.0 / 3 : 1.0 / 3) * (p[1] == 0 ? 4.0 / 3 : 1.0 / 3);
    }
    default:
      return 0.0;
  }
}

struct QuadraturePoint {
  ReferencePoint at;
  double weight;
};

/// Products of Gauss rules; on triangles with one edge of the square collapsed to a vertex.
std::vector<QuadraturePoint> quadrature(Cell cell) {
  static const LineRule rule = gaussRule(kPoints);
  std::vector<QuadraturePoint> all;
  for (int i = 0; i < kPoints; ++i)
    for (int j = 0; j < kPoints; ++j) {
      const double s = rule.points(i), t = rule.points(j), weight = rule.weights(i) * rule.weights(j);
      if (cellInfo(cell).vertices == 4)
        all.push_back({{s, t, 0}, weight});
      else
        all.push_back({{(1 + s) / 2, (1 - s) * (1 + t) / 4, 0}, weight * (1 - s) / 8});
    }
  return all;
}

void addSizesInSpace(const std::vector<Point>& points, std::vector<double>& sizes) {
  const Cell cell = sideCell(static_cast<int>(points.size()));
  ShapeJet jets[kMostSideNodes];
  for (const QuadraturePoint& q : quadrature(cell)) {
    shapeJets(cell, q.at, jets);
    const double area = q.weight * norm(density(points, jets));
    for (std::size_t i = 0; i < points.size(); ++i) sizes[i] += area * jets[i].value;
  }
}

// The radius adds a factor that the nodal quadrature cannot integrate: a node on the axis has an area, too. Exact for straight sides.
void addSizesOfCircle(const std::vector<Point>& points, std::vector<double>& sizes) {
  static const LineRule rule = gaussRule(5);
  for (int q = 0; q < rule.points.size(); ++q) {
    const SideShape shape = sideShape(static_cast<int>(points.size()), rule.points(q));
    double radius = 0, dx = 0, dy = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      radius += shape.value[i] * points[i][0], dx += shape.slope[i] * points[i][0], dy += shape.slope[i] * points[i][1];
    for (std::size_t i = 0; i < points.size(); ++i)
      sizes[i] += rule.weights(q) * circumference(radius) * std::hypot(dx, dy) * shape.value[i];
  }
}

}  // namespace

int sideVertices(int nodes, int dimension) {
  if (dimension == 3) return cellInfo(sideCell(nodes)).vertices;
  if (nodes != 2 && nodes != 3) noSuchSide(nodes, dimension);
  return 2;
}

std::vector<NodeNormal> nodeNormals(const std::vector<Point>& points, int dimension) {
  if (dimension == 2) return nodeNormalsInPlane(points);
  const Cell cell = sideCell(static_cast<int>(points.size()));
  std::vector<NodeNormal> normals;
  ShapeJet jets[kMostSideNodes];
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    shapeJets(cell, referencePoint(cell, i), jets);
    normals.push_back({density(points, jets), weightInSpace(cell, i)});
  }
  return normals;
}

void addTributarySizes(const std::vector<Point>& points, int dimension, bool axisymmetric, std::vector<double>& sizes) {
  if (dimension == 3) return addSizesInSpace(points, sizes);
  if (axisymmetric) return addSizesOfCircle(points, sizes);
  const std::vector<NodeNormal> normals = nodeNormals(points, dimension);
  for (std::size_t i = 0; i < normals.size(); ++i) sizes[i] += normals[i].weight * norm(normals[i].density);
}

std::vector<std::pair<int, int>> sideSteps(int nodes, int dimension) {
  const int vertices = sideVertices(nodes, dimension), edges = dimension == 2 ? 1 : vertices;
  std::vector<std::pair<int, int>> steps;
  for (int k = 0; k < edges; ++k) {
    const int from = k, to = (k + 1) % vertices;
    if (nodes == vertices) {
      steps.push_back({from, to});
      continue;
    }
    steps.push_back({from, vertices + k});
    steps.push_back({vertices + k, to});
    if (nodes == 9) steps.push_back({vertices + k, 8});
  }
  return steps;
}

std::vector<std::vector<int>> linearCells(int nodes, int dimension) {
  if (dimension == 2) return nodes == 2 ? std::vector<std::vector<int>>{{0, 1}} : std::vector<std::vector<int>>{{0, 2}, {2, 1}};
  switch (sideCell(nodes)) {
    case Cell::Triangle3:
      return {{0, 1, 2}};
    case Cell::Quadrilateral4:
      return {{0, 1, 2, 3}};
    case Cell::Triangle6:
      return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    case Cell::Quadrilateral8:
      return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6, 7}};
    case Cell::Quadrilateral9:
      return {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
    default:
      noSuchSide(nodes, dimension);
  }
}

}  // namespace suture
