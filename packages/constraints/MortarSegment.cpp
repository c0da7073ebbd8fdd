#include <suture/constraints/MortarSegment.hpp>
#include <suture/mesh/SideShape.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

Point mix(const std::vector<Point>& points, const std::array<double, 3>& by) {
  Point sum{0, 0, 0};
  for (std::size_t a = 0; a < points.size(); ++a)
    for (int k = 0; k < 2; ++k) sum[k] += by[a] * points[a][k];
  return sum;
}

}  // namespace

MortarSegment::MortarSegment(const Mesh& mesh, const BoundaryLine& line, const std::vector<int>& nodes, const BoundaryCurve::Bend& bend)
    : nodes_(nodes), bend_(bend) {
  for (const int node : nodes) {
    points_.push_back(mesh.point(node));
    normals_.push_back(unit(line.normal(node)));
  }
  if (isLinear()) return;
  const Point chord = unit(minus(points_[1], points_[0]));
  const double height = cross(minus(points_[2], points_[0]), chord);  // outward: to the right of the chord
  straight_ = std::abs(height) < std::abs(arcOver(bend_.at(0), length(), 0).height) / 2;
  if (!straight_) awayFromArc_ = std::abs(height * height * height) / (length() * length());  // next term of the arc's series
}

Point MortarSegment::mixed(double xi) const { return mix(points_, sideShape(count(), xi).value); }
Point MortarSegment::tangent(double xi) const { return mix(points_, sideShape(count(), xi).slope); }

Point MortarSegment::normalAt(double xi) const { return unit(mix(normals_, sideShape(count(), xi).value)); }

// A step s along the direction leads from xi to the place u + s t.d on the chord, at the height s m.d: where the arc has that height.
double MortarSegment::wayToArc(double curvature, double xi, const Point& direction) const {
  if (curvature == 0) return 0.0;
  const Point t = unit(minus(points_[1], points_[0])), m{t[1], -t[0], 0};
  const Bulge arc = arcOver(curvature, length(), xi);
  return arc.height / std::max(dot(m, direction) - arc.slope * dot(t, direction), 0.1);
}

}  // namespace suture
