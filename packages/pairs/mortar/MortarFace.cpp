#include <suture/mesh/GaussRule.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/pairs/mortar/MortarFace.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suture {

namespace {

constexpr double kStraightEdge = 1e-10;  // distance of a mid-side node from the middle of its edge, relative to the element
constexpr double kFlat = 1e-6;           // angle between the normals of a flat face
constexpr double kSolved = 1e-7;         // last step of Newton's method in the reference cell: the error is of the order of its square
constexpr double kLeft = 4.0;            // reference coordinate beyond which a search has left the element
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

double Projection::wayTo(const Point& on, const Point& area, const PlanePoint& place) const {
  const Point arm = minus(minus(minus(on, origin_), scaled(place[0], first)), scaled(place[1], second));
  return dot(arm, area) / dot(along, area);
}

std::map<int, Point> MortarFace::drawnNormals(const Surface& surface) {
  std::map<int, Point> all;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int>& nodes = surface.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(surface.at(node).drawn);
    const std::vector<NodeNormal> normals = nodeNormals(points, surface.dimension());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      Point& sum = all.try_emplace(nodes[i], Point{0, 0, 0}).first->second;
      sum = plus(sum, scaled(normals[i].weight, normals[i].density));
    }
  }
  for (auto& entry : all) entry.second = unit(entry.second);
  return all;
}

MortarFace::MortarFace(const Surface& surface, int side, int body, const std::map<int, Point>* drawn)
    : cell_(sideCell(static_cast<int>(surface.nodesOf(side).size()))), body_(body) {
  for (const int node : surface.nodesOf(side)) {
    points_.push_back(surface.at(node).position);
    normals_.push_back(surface.normal(node));
    size_ = std::max(size_, norm(minus(points_.back(), points_.front())));
  }
  const int count = static_cast<int>(points_.size()), corners = vertices();
  const auto isBetween = [&](int middle, int a, int b) {
    return norm(minus(scaled(2, points_[middle]), plus(points_[a], points_[b]))) <= kStraightEdge * size_;
  };
  for (int k = 0; k < corners && count > corners; ++k) straight_ = straight_ && isBetween(corners + k, k, (k + 1) % corners);
  if (straight_) {
    facets_.emplace_back(corners);
    std::iota(facets_[0].begin(), facets_[0].end(), 0);
  } else {
    facets_ = linearCells(count, 3);
  }
  if (corners == 4) distortion_ = norm(minus(plus(points_[0], points_[2]), plus(points_[1], points_[3]))) / size_;
  if (count == 9) distortion_ = std::max(distortion_, norm(minus(scaled(2, points_[8]), plus(points_[0], points_[2]))) / size_);
  if (distortion_ <= kStraightEdge) distortion_ = 0.0;
  // A property of the drawn element: while bodies move, loads bend flat faces by more than this angle.
  std::vector<Point> shape = normals_;
  for (std::size_t i = 0; drawn && i < shape.size(); ++i) shape[i] = drawn->at(surface.nodesOf(side)[i]);
  curved_ = std::any_of(shape.begin(), shape.end(), [&](const Point& normal) { return angleBetween(normal, shape[0]) > kFlat; });
}

Point MortarFace::normalAt(const ReferencePoint& at) const {
  const ShapeValues values = sideValues(static_cast<int>(normals_.size()), 3, at);
  Point sum{0, 0, 0};
  for (std::size_t i = 0; i < normals_.size(); ++i) sum = plus(sum, scaled(values[i], normals_[i]));
  return unit(sum);
}

MortarFace::Place MortarFace::place(const ReferencePoint& at) const {
  Place place;
  place.at = at;
  ShapeJet shapes[kMostSideNodes];
  shapeJets(cell_, at, shapes);
  Point s{0, 0, 0}, t{0, 0, 0};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    place.values[i] = shapes[i].value;
    for (int k = 0; k < 3; ++k) {
      place.point[k] += shapes[i].value * points_[i][k];
      s[k] += shapes[i].gradient[0] * points_[i][k];
      t[k] += shapes[i].gradient[1] * points_[i][k];
    }
  }
  place.density = cross(s, t);
  return place;
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

ProjectedFace::ProjectedFace(const MortarFace& face, const std::vector<int>& facet, const Projection& projection) : face_(face) {
  for (std::size_t i = 0; i < face.points().size(); ++i) nodes_[i] = projection(face.points()[i]);
  const int last = facet.back();
  const PlanePoint &a = nodes_[facet[0]], &b = nodes_[facet[1]], &c = nodes_[last];
  origin_ = a, start_ = referencePoint(face.cell(), facet[0]);
  const ReferencePoint toB = minus(referencePoint(face.cell(), facet[1]), start_), toC = minus(referencePoint(face.cell(), last), start_);
  const double b0 = b[0] - a[0], b1 = b[1] - a[1], c0 = c[0] - a[0], c1 = c[1] - a[1], det = b0 * c1 - b1 * c0;
  for (int k = 0; k < 2; ++k) slope_[2 * k] = (toB[k] * c1 - toC[k] * b1) / det, slope_[2 * k + 1] = (toC[k] * b0 - toB[k] * c0) / det;
}

std::optional<MortarFace::Place> ProjectedFace::meet(const PlanePoint& point) const {
  const double x = point[0] - origin_[0], y = point[1] - origin_[1];
  ReferencePoint at{start_[0] + slope_[0] * x + slope_[1] * y, start_[1] + slope_[2] * x + slope_[3] * y, 0};
  if (face_.isStraight() && face_.distortion() == 0) return face_.place(at);
  const std::size_t count = face_.points().size();
  ShapeJet shapes[kMostSideNodes];
  for (int step = 0; step < kSteps; ++step) {
    shapeJets(face_.cell(), at, shapes);
    double away[2] = {0, 0}, s[2] = {0, 0}, t[2] = {0, 0};
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < 2; ++k) {
        const double arm = nodes_[i][k] - point[k];
        away[k] += shapes[i].value * arm;
        s[k] += shapes[i].gradient[0] * arm;
        t[k] += shapes[i].gradient[1] * arm;
      }
    const double det = s[0] * t[1] - s[1] * t[0];
    if (det == 0) return std::nullopt;
    const double ds = (away[0] * t[1] - away[1] * t[0]) / det, dt = (s[0] * away[1] - s[1] * away[0]) / det;
    at[0] -= ds, at[1] -= dt;
    if (!(std::abs(at[0]) < kLeft && std::abs(at[1]) < kLeft)) return std::nullopt;
    if (std::abs(ds) + std::abs(dt) <= kSolved) return face_.place(at);
  }
  return std::nullopt;
}

}  // namespace suture
