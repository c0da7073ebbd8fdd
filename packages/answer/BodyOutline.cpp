#include <suture/answer/BodyOutline.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace suture {

namespace {

constexpr double kSamePoint = 1e-9;  // fraction of a side
constexpr double kHalfTurn = 3.14159265358979323846;

}  // namespace

bool meet(const BoundingBox& a, const BoundingBox& b) {
  for (int k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

BodyOutline::BodyOutline(int dimension, std::vector<const Facet*> facets)
    : dimension_(dimension), facets_(std::move(facets)), tree_(boxes()) {}

std::vector<BoundingBox> BodyOutline::boxes() const {
  std::vector<BoundingBox> all;
  for (const Facet* facet : facets_) {
    BoundingBox& box = all.emplace_back();
    for (int k = 0; k < dimension_; ++k) box.include(facet->corners[k]);
  }
  return all;
}

BodyOutline::Nearest BodyOutline::onSegment(const Point& a, const Point& b, const Point& p) {
  const Point along = minus(b, a);
  const double t = dot(minus(p, a), along) / dot(along, along);
  if (t <= 0.0) return {a, kHalfTurn, true};
  if (t >= 1.0) return {b, kHalfTurn, true};
  return {plus(a, scaled(t, along)), kHalfTurn, false};
}

BodyOutline::Nearest BodyOutline::onTriangle(const std::array<Point, 3>& corners, const Point& normal, const Point& p) {
  bool inside = true;
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
    if (dot(cross(minus(b, a), minus(p, a)), normal) > 0.0) continue;
    inside = false;
    Nearest found = onSegment(a, b, p);
    if (found.point == a)
      found.angle = angleBetween(minus(b, a), minus(c, a));
    else if (found.point == b)
      found.angle = angleBetween(minus(a, b), minus(c, b));
    found.onRim = true;
    const double away = norm(minus(found.point, p));
    if (away < least) least = away, best = found;
  }
  if (!inside) return best;
  return {minus(p, scaled(dot(minus(p, corners[0]), normal), normal)), 2.0 * kHalfTurn, false};
}

BodyOutline::Nearest BodyOutline::nearestOn(const Facet& facet, const Point& p) const {
  return dimension_ == 2 ? onSegment(facet.corners[0], facet.corners[1], p) : onTriangle(facet.corners, facet.normal, p);
}

BodyOutline::Depth BodyOutline::depthAt(const Point& p) const {
  const int at = tree_.nearest(p, [&](int i) { return norm(minus(nearestOn(*facets_[i], p).point, p)); });
  const Nearest nearest = nearestOn(*facets_[at], p);
  const Point way = minus(p, nearest.point);
  Point sense = facets_[at]->normal;
  if (nearest.onRim) {
    const double reach = kSamePoint * facets_[at]->size;
    sense = {0, 0, 0};
    for (const int i : tree_.find([&](const BoundingBox& box) { return box.distance(nearest.point) <= reach; })) {
      const Nearest other = nearestOn(*facets_[i], nearest.point);
      if (norm(minus(other.point, nearest.point)) <= reach) sense = plus(sense, scaled(other.angle, facets_[i]->normal));
    }
  }
  return {dot(way, sense) < 0.0 ? norm(way) : -norm(way), facets_[at]};
}

std::vector<double> BodyOutline::crossings(const Point& a, const Point& b) const {
  BoundingBox box;
  box.include(a);
  box.include(b);
  std::vector<double> all;
  for (const int i : tree_.find([&](const BoundingBox& other) { return meet(box, other); }))
    if (const double t = crossing(*facets_[i], a, b); t > 0.0 && t < 1.0) all.push_back(t);
  std::sort(all.begin(), all.end());
  return all;
}

double BodyOutline::crossing(const Facet& facet, const Point& a, const Point& b) const {
  const double before = dot(minus(a, facet.corners[0]), facet.normal), after = dot(minus(b, facet.corners[0]), facet.normal);
  if ((before > 0.0) == (after > 0.0) || before == after) return -1.0;
  const double t = before / (before - after);
  const Point p = plus(a, scaled(t, minus(b, a)));
  return norm(minus(nearestOn(facet, p).point, p)) <= kSamePoint * facet.size ? t : -1.0;
}

}  // namespace suture
