#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SideShape.hpp>
#include <suture/pairing/PairFrame.hpp>
#include <suture/pairing/mortar/MortarFace.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suture {

namespace {

constexpr double kStraightEdge = 1e-10;  // distance of an edge's middle node from the middle, relative to the element
constexpr double kFlat = 1e-6;           // angle between the normals of a flat face
constexpr double kSolved = 1e-9;         // last step of Newton's method in the reference cell: the error is of the order of its square
constexpr double kLeft = 3.0;            // distance from the middle of the reference cell at which a search has left the element
constexpr int kSteps = 25;

}  // namespace

Projection::Projection(const Point& direction, const Point& origin) : along(direction), origin_(origin) {
  const std::vector<Point> frame = pairFrame(along, 3);
  first = frame[1], second = frame[2];
}

PlanePoint Projection::operator()(const Point& point) const {
  const Point arm = minus(point, origin_);
  return {dot(first, arm), dot(second, arm)};
}

Polygon Projection::operator()(const std::vector<Point>& points) const {
  Polygon polygon;
  for (const Point& point : points) polygon.push_back((*this)(point));
  return polygon;
}

Point Projection::at(const PlanePoint& place) const { return plus(origin_, plus(scaled(place[0], first), scaled(place[1], second))); }

MortarFace::MortarFace(const Surface& surface, int side, int body)
    : cell_(sideCell(static_cast<int>(surface.nodesOf(side).size()))), body_(body) {
  double size = 0;
  for (const int node : surface.nodesOf(side)) {
    points_.push_back(surface.at(node).position);
    normals_.push_back(surface.normal(node));
    size = std::max(size, norm(minus(points_.back(), points_.front())));
  }
  const int count = static_cast<int>(points_.size()), corners = vertices();
  const auto isBetween = [&](int middle, int a, int b) {
    return norm(minus(scaled(2, points_[middle]), plus(points_[a], points_[b]))) <= kStraightEdge * size;
  };
  for (int k = 0; k < corners && count > corners; ++k) straight_ = straight_ && isBetween(corners + k, k, (k + 1) % corners);
  if (straight_) {
    facets_.emplace_back(corners);
    std::iota(facets_[0].begin(), facets_[0].end(), 0);
  } else {
    facets_ = linearCells(count, 3);
  }
  if (corners == 4) distortion_ = norm(minus(plus(points_[0], points_[2]), plus(points_[1], points_[3]))) / size;
  if (count == 9) distortion_ = std::max(distortion_, norm(minus(scaled(2, points_[8]), plus(points_[0], points_[2]))) / size);
  if (distortion_ <= kStraightEdge) distortion_ = 0.0;
  curved_ = std::any_of(normals_.begin(), normals_.end(), [&](const Point& normal) { return angleBetween(normal, normals_[0]) > kFlat; });
}

Point MortarFace::normalAt(const ReferencePoint& at) const {
  Point sum{0, 0, 0};
  for (std::size_t i = 0; i < normals_.size(); ++i) sum = plus(sum, scaled(shapeFunction(cell_, static_cast<int>(i), at), normals_[i]));
  return unit(sum);
}

Point MortarFace::at(const ReferencePoint& at) const {
  Point sum{0, 0, 0};
  for (std::size_t i = 0; i < points_.size(); ++i) sum = plus(sum, scaled(shapeFunction(cell_, static_cast<int>(i), at), points_[i]));
  return sum;
}

Point MortarFace::density(const ReferencePoint& at) const {
  Point s{0, 0, 0}, t{0, 0, 0};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ReferencePoint g = shapeGradient(cell_, static_cast<int>(i), at);
    s = plus(s, scaled(g[0], points_[i]));
    t = plus(t, scaled(g[1], points_[i]));
  }
  return cross(s, t);
}

std::vector<std::pair<ReferencePoint, double>> MortarFace::quadrature() const {
  std::vector<std::pair<ReferencePoint, double>> all;
  if (vertices() == 3) {
    const TriangleRule& rule = triangleRule(10);
    for (std::size_t q = 0; q < rule.points.size(); ++q) all.push_back({{rule.points[q][1], rule.points[q][2], 0}, rule.weights[q] / 2});
    return all;
  }
  const LineRule rule = gaussRule(6);
  for (int i = 0; i < rule.points.size(); ++i)
    for (int j = 0; j < rule.points.size(); ++j) all.push_back({{rule.points(i), rule.points(j), 0}, rule.weights(i) * rule.weights(j)});
  return all;
}

std::map<int, double> vertexHats(const Surface& surface) {
  std::map<int, double> hats;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int> corners(surface.nodesOf(side).begin(), surface.nodesOf(side).begin() + surface.facets(side));
    std::vector<Point> points;
    for (const int node : corners) points.push_back(surface.at(node).position);
    std::vector<double> sizes(corners.size(), 0.0);
    addTributarySizes(points, 3, false, sizes);
    for (std::size_t k = 0; k < sizes.size(); ++k) hats[corners[k]] += sizes[k];
  }
  return hats;
}

std::optional<ReferencePoint> MortarFace::meet(const Point& point, const Projection& projection, const ReferencePoint& start) const {
  const ReferencePoint centre = referenceCentre(cell_);
  ReferencePoint place = start;
  for (int step = 0; step < kSteps; ++step) {
    Point away{0, 0, 0}, s{0, 0, 0}, t{0, 0, 0};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const int node = static_cast<int>(i);
      const Point arm = minus(points_[i], point);
      const ReferencePoint g = shapeGradient(cell_, node, place);
      away = plus(away, scaled(shapeFunction(cell_, node, place), arm));
      s = plus(s, scaled(g[0], arm));
      t = plus(t, scaled(g[1], arm));
    }
    const double r0 = dot(projection.first, away), r1 = dot(projection.second, away), s0 = dot(projection.first, s),
                 s1 = dot(projection.second, s), t0 = dot(projection.first, t), t1 = dot(projection.second, t), det = s0 * t1 - s1 * t0;
    if (det == 0) return std::nullopt;
    const double ds = (r0 * t1 - r1 * t0) / det, dt = (s0 * r1 - s1 * r0) / det;
    place[0] -= ds, place[1] -= dt;
    if (!(norm(minus(place, centre)) < kLeft)) return std::nullopt;
    if (std::abs(ds) + std::abs(dt) <= kSolved) return place;
  }
  return std::nullopt;
}

}  // namespace suture
