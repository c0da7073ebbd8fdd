#include <suture/mesh/GaussRule.hpp>
#include <suture/pairs/mortar/Clipping.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kNoArea = 1e-15;  // least intersection of two polygons, relative to the smaller one

/// Twice the area of a triangle, positive if its corners run counter-clockwise.
double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Distance of a point from the line through two others, positive on its left.
double leftOf(const PlanePoint& a, const PlanePoint& b, const PlanePoint& point) {
  const double x = b[0] - a[0], y = b[1] - a[1];
  return turn(a, b, point) / std::sqrt(x * x + y * y);
}

/// The part of a convex polygon on the left of a line.
Polygon cut(const Polygon& polygon, const PlanePoint& a, const PlanePoint& b, double tolerance) {
  Polygon kept;
  const std::size_t n = polygon.size();
  std::vector<double> left(n);
  for (std::size_t i = 0; i < n; ++i) {
    left[i] = leftOf(a, b, polygon[i]);
    if (std::abs(left[i]) <= tolerance) left[i] = 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (left[i] >= 0) kept.push_back(polygon[i]);
    if (left[i] * left[next] >= 0) continue;
    const double way = left[i] / (left[i] - left[next]);
    kept.push_back({polygon[i][0] + way * (polygon[next][0] - polygon[i][0]), polygon[i][1] + way * (polygon[next][1] - polygon[i][1])});
  }
  return kept;
}

TriangleRule sevenPoints() {
  const double root = std::sqrt(15.0), near = (6 + root) / 21, far = (6 - root) / 21;
  TriangleRule rule{{{1.0 / 3, 1.0 / 3, 1.0 / 3}}, {9.0 / 40}};
  for (const auto& [at, weight] : {std::make_pair(far, (155 - root) / 1200), std::make_pair(near, (155 + root) / 1200)})
    for (int k = 0; k < 3; ++k) {
      std::array<double, 3> point{at, at, at};
      point[k] = 1 - 2 * at;
      rule.points.push_back(point);
      rule.weights.push_back(weight);
    }
  return rule;
}

TriangleRule product(int points) {
  const LineRule line = gaussRule(points);
  TriangleRule rule;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double s = (1 + line.points(i)) / 2, t = (1 - s) * (1 + line.points(j)) / 2;
      rule.points.push_back({1 - s - t, s, t});
      rule.weights.push_back(line.weights(i) * line.weights(j) * (1 - s) / 2);
    }
  return rule;
}

}  // namespace

double areaOf(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += turn(polygon[0], polygon[i], polygon[i + 1]);
  return sum / 2;
}

std::vector<std::vector<int>> convexParts(const Polygon& polygon) {
  const int n = static_cast<int>(polygon.size());
  std::vector<int> all(n);
  for (int i = 0; i < n; ++i) all[i] = i;
  if (n != 4) return {all};
  for (int i = 0; i < n; ++i)
    if (turn(polygon[(i + 3) % 4], polygon[i], polygon[(i + 1) % 4]) < 0)
      return {{i, (i + 1) % 4, (i + 2) % 4}, {i, (i + 2) % 4, (i + 3) % 4}};
  return {all};
}

Polygon commonPart(const Polygon& polygon, const Polygon& by, double tolerance) {
  Polygon common = polygon;
  for (std::size_t i = 0; i < by.size() && common.size() > 2; ++i) common = cut(common, by[i], by[(i + 1) % by.size()], tolerance);
  if (common.size() < 3 || areaOf(common) <= kNoArea * std::min(areaOf(polygon), areaOf(by))) return {};
  return common;
}

bool contains(const Polygon& convex, const PlanePoint& point, double tolerance) {
  for (std::size_t i = 0; i < convex.size(); ++i)
    if (leftOf(convex[i], convex[(i + 1) % convex.size()], point) < -tolerance) return false;
  return true;
}

const TriangleRule& triangleRule(int degree) {
  static std::map<int, TriangleRule> rules{{0, sevenPoints()}};
  const int points = degree <= 5 ? 0 : (degree + 3) / 2;
  const auto found = rules.find(points);
  return found != rules.end() ? found->second : rules.emplace(points, product(points)).first->second;
}

}  // namespace suture
