#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/FaceSampling.hpp>
#include <suture/pairs/mortar/LineSampling.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

namespace suture {

namespace {

constexpr double kAntiparallel = 1e-9;  // sine of the angle
// Cosine of half the angle between two edges of a rim up to which they belong to a smooth curve. Not critical: edges of a circle turn by
// degrees, those of a block by ninety.
constexpr double kSmoothRim = 0.9;

}  // namespace

std::map<int, Point> rimOf(const Surface& surface) {
  std::map<int, std::vector<Point>> along;  // directions of the edges at each node
  for (int side = 0; side < surface.sides(); ++side)
    for (int k = 0; k < surface.facets(side); ++k) {
      if (surface.across(side, k).side >= 0) continue;
      const std::vector<int>& nodes = surface.nodesOf(side);
      if (surface.dimension() == 2) {
        along[nodes[k]];
        continue;
      }
      const int begin = nodes[k], end = nodes[(k + 1) % surface.facets(side)];
      const Point direction = unit(minus(surface.at(end).position, surface.at(begin).position));
      along[begin].push_back(direction), along[end].push_back(direction);
      if (static_cast<int>(nodes.size()) > surface.facets(side)) along[nodes[surface.facets(side) + k]].push_back(direction);
    }
  std::map<int, Point> rim;
  for (const auto& [node, directions] : along) {
    Point sum{0, 0, 0};
    for (const Point& direction : directions) sum = plus(sum, direction);
    const bool isCorner = directions.empty() || norm(sum) < kSmoothRim * static_cast<double>(directions.size());
    rim[node] = isCorner ? Point{0, 0, 0} : unit(sum);
  }
  return rim;
}

Point rowNormalOf(const Point& own, const Point& facing, const Point* rim) {
  if (norm(cross(own, facing)) <= kAntiparallel) return own;
  const Point mean = unit(minus(own, facing)), other = scaled(-1.0, facing);
  return rim ? unit(plus(other, scaled(dot(minus(mean, other), *rim), *rim))) : mean;
}

std::unique_ptr<MortarSampling> samplingOf(const Mesh& mesh, const ContactSurface& contact, bool onA) {
  if (mesh.dimension == 2) return std::make_unique<LineSampling>(mesh, contact, onA);
  return std::make_unique<FaceSampling>(mesh, contact, onA);
}

}  // namespace suture
