#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/pairs/mortar/MortarSegment.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Fraction of the cubic deviation of a line from a parabola that affects the pressures. Neighbouring elements deviate nearly alike, and
// displacements compensate the rest. Calibrated on ellipses of axes 1.5 and 3 with 16:12 and 8:12 elements per quarter, where nodal
// pressures are 1.5 to 13 % wrong.
constexpr double kNotFollowed = 1.0 / 13;

Point mix(const std::vector<Point>& points, const std::array<double, 3>& by) {
  Point sum{0, 0, 0};
  for (std::size_t a = 0; a < points.size(); ++a)
    for (int k = 0; k < 2; ++k) sum[k] += by[a] * points[a][k];
  return sum;
}

}  // namespace

MortarSegment::MortarSegment(const Surface& surface, int side, const BoundaryCurve::Bend& bend, int body)
    : nodes_(surface.nodesOf(side)), body_(body), bend_(bend) {
  for (const int node : nodes_) {
    points_.push_back(surface.at(node).position);
    normals_.push_back(unit(surface.normal(node)));
  }
  if (isLinear()) return;
  const Point chord = unit(minus(points_[1], points_[0]));
  height_ = cross(minus(points_[2], points_[0]), chord)[2];  // outward: to the right of the chord
  skew_ = dot(minus(points_[2], points_[0]), chord) - length() / 2;
  // A property of the drawn element: while bodies move, loads bend it by as much as its height.
  const auto drawn = [&](int node) { return surface.at(nodes_[node]).drawn; };
  const Point drawnChord = minus(drawn(1), drawn(0));
  const double drawnHeight = cross(minus(drawn(2), drawn(0)), unit(drawnChord))[2];
  straight_ = std::abs(drawnHeight) < std::abs(arcOver(bend_.at(0), norm(drawnChord), 0).height) / 8;
}

Point MortarSegment::mixed(double xi) const { return mix(points_, sideShape(count(), xi).value); }
Point MortarSegment::tangent(double xi) const { return mix(points_, sideShape(count(), xi).slope); }

Point MortarSegment::normalAt(double xi) const { return unit(mix(normals_, sideShape(count(), xi).value)); }

double MortarSegment::awayFromCurve(double xi) const {
  const double h = length();
  const double arc = std::abs(height_ * height_ * height_) / (h * h);  // next term of the arc's series
  // A mid-side node off the middle gives the parabola its own cubic part.
  return arc + kNotFollowed * (change_ * h * h / 48 - 4 * height_ * skew_ / h) * xi * (1 - xi * xi);
}

// A step s along the direction leads from xi to the position u + s t.d on the chord, at the height s m.d: finds s where the arc has this
// height.
double MortarSegment::wayToArc(double curvature, double xi, const Point& direction) const {
  if (curvature == 0) return 0.0;
  const Point t = unit(minus(points_[1], points_[0])), m{t[1], -t[0], 0};
  const Bulge arc = arcOver(curvature, length(), xi);
  return arc.height / std::max(dot(m, direction) - arc.slope * dot(t, direction), 0.1);
}

}  // namespace suture
