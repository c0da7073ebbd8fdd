#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/CellSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kInside = 1e-9;  // fraction of an element's size: round-off of a point on a side
constexpr double kBulge = 0.125;  // fraction of the nodes' box by which a curved side may leave the box
constexpr double kFar = 1.0;      // element sizes: farther outside, reference coordinates are meaningless
constexpr int kNewtonSteps = 25;

/// Distance of a reference point from its cell, whose edges have a length of about one.
double outsideBy(Cell cell, const ReferencePoint& p) {
  const double beyond[3] = {0.5 * (std::abs(p[0]) - 1.0), 0.5 * (std::abs(p[1]) - 1.0), 0.5 * (std::abs(p[2]) - 1.0)};
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
      return std::max({0.0, -p[0], -p[1], p[0] + p[1] - 1.0});
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return std::max({0.0, -p[0], -p[1], -p[2], p[0] + p[1] + p[2] - 1.0});
    case Cell::Wedge6:
      return std::max({0.0, -p[0], -p[1], p[0] + p[1] - 1.0, beyond[2]});
    case Cell::Pyramid5:
      return std::max({0.0, -p[2], beyond[0] + 0.5 * p[2], beyond[1] + 0.5 * p[2]});
    default:
      return std::max({0.0, beyond[0], beyond[1], beyond[2]});  // in 2D the third is negative
  }
}

BoundingBox boxOf(const CellBlock& block, int element) {
  BoundingBox box;
  for (const int node : block.nodesOf(element)) box.include(block.point(node));
  const bool curved = cellInfo(block.cells[element]).order > 1;
  const double margin = (curved ? kBulge + CellSearch::kNear : CellSearch::kNear) * norm(minus(box.high, box.low));
  for (int k = 0; k < block.dimension; ++k) box.low[k] -= margin, box.high[k] += margin;
  return box;
}

std::vector<BoundingBox> boxesOf(const CellBlock& block) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(block.cells.size());
  for (int e = 0; e < block.elements(); ++e) boxes.push_back(boxOf(block, e));
  return boxes;
}

/// x with a x = b, a given by its columns. False if the columns are linearly dependent.
bool solve(const std::array<Point, 3>& a, const Point& b, Point& x) {
  const Point cofactor = cross(a[1], a[2]);
  const double det = dot(a[0], cofactor);
  if (!(std::abs(det) > 0.0)) return false;
  x = {dot(b, cofactor) / det, dot(b, cross(a[2], a[0])) / det, dot(b, cross(a[0], a[1])) / det};
  return true;
}

/// Weights of the corners of a segment or triangle at its point nearest to a place.
std::array<double, 3> nearestWeights(const Point* corners, int count, const Point& place) {
  const Point u = minus(corners[1], corners[0]), w = minus(place, corners[0]);
  if (count == 2) {
    const double t = std::clamp(dot(w, u) / dot(u, u), 0.0, 1.0);
    return {1.0 - t, t, 0.0};
  }
  const Point v = minus(corners[2], corners[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v), det = uu * vv - uv * uv;
  const double b = (vv * wu - uv * wv) / det, c = (uu * wv - uv * wu) / det;
  if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) return {1.0 - b - c, b, c};
  std::array<double, 3> best{1.0, 0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Point edge[2] = {corners[k], corners[(k + 1) % 3]};
    const auto along = nearestWeights(edge, 2, place);
    const double distance = norm(minus(plus(scaled(along[0], edge[0]), scaled(along[1], edge[1])), place));
    if (!(distance < least)) continue;
    least = distance;
    best = {0.0, 0.0, 0.0};
    best[std::size_t(k)] = along[0];
    best[std::size_t((k + 1) % 3)] = along[1];
  }
  return best;
}

}  // namespace

CellSearch::CellSearch(const CellBlock& block) : block_(block), tree_(boxesOf(block)) {}

bool CellSearch::invert(int element, const Point& place, double most, Place& found) const {
  const Cell cell = block_.cells[element];
  const Span<const int> nodes = block_.nodesOf(element);
  const bool isAffine = cell == Cell::Triangle3 || cell == Cell::Tetrahedron4;
  found.element = element;
  found.at = referenceCentre(cell);
  ShapeJet jets[kMostCellNodes];
  for (int step = 0; step < kNewtonSteps; ++step) {
    shapeJets(cell, found.at, jets);
    Point away{-place[0], -place[1], -place[2]}, correction;
    std::array<Point, 3> tangents{{{0, 0, 0}, {0, 0, 0}, {0, 0, block_.dimension == 2 ? 1.0 : 0.0}}};
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Point p = block_.point(nodes[a]);
      for (int k = 0; k < block_.dimension; ++k) {
        away[k] += jets[a].value * p[k];
        for (int j = 0; j < block_.dimension; ++j) tangents[j][k] += jets[a].gradient[j] * p[k];
      }
    }
    if (!solve(tangents, away, correction)) return false;
    found.at = minus(found.at, correction);
    found.outside = outsideBy(cell, found.at);
    if (!(found.outside < 10.0)) return false;
    if (isAffine || std::abs(correction[0]) + std::abs(correction[1]) + std::abs(correction[2]) < 1e-13) break;
  }
  if (found.outside <= kInside) found.outside = 0.0;
  return found.outside <= most;
}

CellSearch::Place CellSearch::find(const Point& point) const {
  Place best, one;
  for (const int element : tree_.find([&](const BoundingBox& box) { return box.distance(point) <= 0.0; }))
    if (invert(element, point, kNear, one) && one.outside < best.outside) best = one;
  return best;
}

CellSearch::Nearest CellSearch::footOn(int element, const Point& place) const {
  const Cell cell = block_.cells[element];
  const CellInfo& info = cellInfo(cell);
  const Span<const int> nodes = block_.nodesOf(element);
  Nearest best;
  best.element = element;
  for (const std::vector<int>& side : info.sideNodes) {
    const int vertices = static_cast<int>(std::count_if(side.begin(), side.end(), [&](int local) { return local < info.vertices; }));
    const int corners = block_.dimension;  // vertices of a facet: a segment, or one of the triangles into which the side is split
    for (int k = 1; k + corners - 2 < vertices; ++k) {
      const int locals[3] = {side[0], side[k], corners == 3 ? side[k + 1] : 0};
      Point facet[3];
      for (int c = 0; c < corners; ++c) facet[c] = block_.point(nodes[locals[c]]);
      const auto weights = nearestWeights(facet, corners, place);
      Point foot{0, 0, 0}, at{0, 0, 0};
      for (int c = 0; c < corners; ++c) {
        foot = plus(foot, scaled(weights[std::size_t(c)], facet[c]));
        at = plus(at, scaled(weights[std::size_t(c)], referencePoint(cell, locals[c])));
      }
      const double distance = norm(minus(foot, place));
      if (distance < best.distance) best.distance = distance, best.foot = foot, best.at = at;
    }
  }
  return best;
}

CellSearch::Nearest CellSearch::nearest(const Point& point) const {
  const int element = tree_.nearest(point, [&](int e) { return footOn(e, point).distance; });
  if (element < 0) return {};
  Nearest found = footOn(element, point);
  found.outside = std::max(kNear, found.distance / diameterOf(block_, element));
  if (Place beyond; invert(element, point, kFar, beyond)) found.at = beyond.at;
  return found;
}

}  // namespace suture
