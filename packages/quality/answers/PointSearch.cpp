#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/quality/answers/PointSearch.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

namespace suture {

namespace {

constexpr double kNear = 0.05;    // part of an element's size: a point so far outside counts as in it
constexpr double kInside = 1e-9;  // part of an element's size: rounding of a point on a side
constexpr double kBulge = 0.125;  // part of the nodes' box by which a curved side may leave it
constexpr int kNewtonSteps = 25;

bool isTriangle(Cell cell) { return cellInfo(cell).vertices == 3; }

/// How far a reference point is outside its cell, whose sides are about one long.
double outsideBy(Cell cell, const ReferencePoint& p) {
  if (isTriangle(cell)) return std::max({0.0, -p[0], -p[1], p[0] + p[1] - 1.0});
  return 0.5 * std::max({0.0, std::abs(p[0]) - 1.0, std::abs(p[1]) - 1.0});
}

/// The reference point that an element maps to a place, by Newton's method. False where it finds none.
bool invert(const CellBlock& block, int element, const Point& place, ReferencePoint& at) {
  const Cell cell = block.cells[element];
  const Span<const int> nodes = block.nodesOf(element);
  at = isTriangle(cell) ? ReferencePoint{1.0 / 3, 1.0 / 3} : ReferencePoint{0, 0};
  for (int step = 0; step < kNewtonSteps; ++step) {
    double x = -place[0], y = -place[1], xu = 0, xv = 0, yu = 0, yv = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Point p = block.point(nodes[a]);
      const double value = shapeFunction(cell, static_cast<int>(a), at);
      const ReferencePoint slope = shapeGradient(cell, static_cast<int>(a), at);
      x += value * p[0], y += value * p[1];
      xu += slope[0] * p[0], xv += slope[1] * p[0], yu += slope[0] * p[1], yv += slope[1] * p[1];
    }
    const double det = xu * yv - xv * yu;
    if (!(std::abs(det) > 0.0)) return false;
    const double u = (yv * x - xv * y) / det, v = (xu * y - yu * x) / det;
    at[0] -= u, at[1] -= v;
    if (!(std::abs(at[0]) < 10.0 && std::abs(at[1]) < 10.0)) return false;
    if (std::abs(u) + std::abs(v) < 1e-13) return true;
  }
  return outsideBy(cell, at) <= kNear;
}

BoundingBox boxOf(const CellBlock& block, int element) {
  BoundingBox box;
  for (const int node : block.nodesOf(element)) box.include(block.point(node));
  const bool curved = cellInfo(block.cells[element]).nodes > cellInfo(block.cells[element]).vertices;
  const double margin = (curved ? kBulge + kNear : kNear) * norm(minus(box.high, box.low));
  for (int k = 0; k < block.dimension; ++k) box.low[k] -= margin, box.high[k] += margin;
  return box;
}

/// Nearest point of an element's polygon to a place outside it.
Point nearestOf(const CellBlock& block, int element, const Point& place) {
  const Span<const int> nodes = block.nodesOf(element);
  const int vertices = cellInfo(block.cells[element]).vertices;
  Point best = block.point(nodes[0]);
  for (int v = 0; v < vertices; ++v) {
    const Point a = block.point(nodes[v]), b = block.point(nodes[(v + 1) % vertices]), side = minus(b, a);
    const double t = std::clamp(dot(minus(place, a), side) / dot(side, side), 0.0, 1.0);
    const Point foot = plus(a, scaled(t, side));
    if (norm(minus(foot, place)) < norm(minus(best, place))) best = foot;
  }
  return best;
}

/// An element that holds a point, or the one nearest to it. Plain.
struct Candidate {
  double off = std::numeric_limits<double>::infinity();  // how far outside: in reference coordinates, or [length]
  GlobalId element = -1;                                 // number in the mesh
  int body = -1, rank = -1;
  Point place{0, 0, 0};

  bool operator<(const Candidate& other) const { return std::tie(off, body, element) < std::tie(other.off, other.body, other.element); }
};

class PointSearch {
 public:
  PointSearch(const Comm& comm, const std::vector<SubdomainMesh>& meshes) : rank_(comm.getRank()), meshes_(meshes) {
    for (const SubdomainMesh& mesh : meshes) {
      std::vector<BoundingBox> boxes;
      for (int e = 0; e < mesh.elements(); ++e) boxes.push_back(boxOf(mesh, e));
      trees_.emplace_back(boxes);
    }
  }

  Candidate find(const SoughtPoint& point, PointInElement& here) const {
    Candidate best;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      const SubdomainMesh& mesh = meshes_[m];
      if (point.body >= 0 && point.body != mesh.body) continue;
      for (const int e : trees_[m].find([&](const BoundingBox& box) { return box.distance(point.place) <= 0.0; })) {
        ReferencePoint at;
        if (!invert(mesh, e, point.place, at)) continue;
        const double off = outsideBy(mesh.cells[e], at);
        const Candidate one{off <= kInside ? 0.0 : off, mesh.globalElements[e], mesh.body, rank_, point.place};
        if (one.off > kNear || !(one < best)) continue;
        best = one;
        here = {static_cast<int>(m), e, at};
      }
    }
    return best;
  }

  Candidate nearest(const SoughtPoint& point) const {
    Candidate best;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      const SubdomainMesh& mesh = meshes_[m];
      if (point.body >= 0 && point.body != mesh.body) continue;
      const auto distance = [&](int e) { return norm(minus(nearestOf(mesh, e, point.place), point.place)); };
      const int e = trees_[m].nearest(point.place, distance);
      if (e < 0) continue;
      const Candidate one{distance(e), mesh.globalElements[e], mesh.body, rank_, nearestOf(mesh, e, point.place)};
      if (one < best) best = one;
    }
    return best;
  }

 private:
  int rank_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<BoxTree> trees_;
};

/// The best of all ranks, for each point.
std::vector<Candidate> bestOf(const Comm& comm, const std::vector<Candidate>& mine) {
  Packer packer;
  packer.put(mine);
  std::vector<Candidate> best(mine.size());
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    const auto theirs = Unpacker(bytes).get<std::vector<Candidate>>();
    for (std::size_t i = 0; i < best.size(); ++i)
      if (theirs[i] < best[i]) best[i] = theirs[i];
  }
  return best;
}

}  // namespace

FoundPoints findPoints(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                       const std::vector<SoughtPoint>& points) {
  FoundPoints found;
  found.here.resize(points.size());
  std::vector<Candidate> mine(points.size());
  std::vector<PointSearch> search;
  collectively(comm, "finding the points of probes", [&] {
    search.emplace_back(comm, meshes);
    for (std::size_t i = 0; i < points.size(); ++i) mine[i] = search[0].find(points[i], found.here[i]);
  });
  const std::vector<Candidate> best = bestOf(comm, mine);
  std::vector<Candidate> nearest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (best[i].rank != comm.getRank()) found.here[i] = {};
    if (best[i].rank >= 0) continue;
    found.outside.push_back(static_cast<int>(i));
    nearest.push_back(search[0].nearest(points[i]));
  }
  if (found.outside.empty()) return found;
  for (const Candidate& one : bestOf(comm, nearest)) {
    char text[300];
    std::snprintf(text, sizeof text, "'%s' is nearest, %.6g away at %s", one.body < 0 ? "" : bodies[one.body].c_str(), one.off,
                  placeText(one.place).c_str());
    found.nearest.push_back(text);
  }
  return found;
}

}  // namespace suture
