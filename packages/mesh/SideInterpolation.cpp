#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SideInterpolation.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Deviation from the interpolation, relative to the largest nodal value, up to which it is round-off.
constexpr double kSamePolynomial = 1e-10;

/// Shape functions of a side's nodes at some points between the nodes, in no special position.
std::vector<std::vector<double>> shapesBetweenNodes(int nodes, int dimension) {
  std::vector<std::vector<double>> all;
  if (dimension == 2) {
    for (const double xi : {-0.6, -0.2, 0.3, 0.7}) {
      const SideShape shape = sideShape(nodes, xi);
      all.emplace_back(shape.value.begin(), shape.value.begin() + nodes);
    }
    return all;
  }
  const Cell cell = sideCell(nodes);
  ShapeJet jets[kMostCellNodes];
  for (const ReferencePoint& at :
       {ReferencePoint{0.2, 0.2, 0}, ReferencePoint{0.6, 0.1, 0}, ReferencePoint{0.1, 0.7, 0}, ReferencePoint{0.3, 0.5, 0}}) {
    shapeJets(cell, at, jets);
    all.emplace_back();
    for (int a = 0; a < nodes; ++a) all.back().push_back(jets[a].value);
  }
  return all;
}

}  // namespace

bool isInterpolated(const std::vector<Point>& points, int dimension, const std::function<double(const Point&)>& value) {
  std::vector<double> nodal;
  double size = 0.0;
  for (const Point& point : points) nodal.push_back(value(point)), size = std::max(size, std::abs(nodal.back()));
  for (const std::vector<double>& shapes : shapesBetweenNodes(static_cast<int>(points.size()), dimension)) {
    Point place{0, 0, 0};
    double interpolated = 0.0;
    for (std::size_t a = 0; a < points.size(); ++a) {
      place = plus(place, scaled(shapes[a], points[a]));
      interpolated += shapes[a] * nodal[a];
    }
    if (!(std::abs(interpolated - value(place)) <= kSamePolynomial * size)) return false;
  }
  return true;
}

}  // namespace suture
