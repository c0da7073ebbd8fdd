#include <suture/base/Point.hpp>
#include <suture/reader/cad/Skin.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kParallel = 0.95;  // smallest cosine of the angle between opposite sides of a wall
constexpr std::size_t kVotes = 3;   // rays that decide the orientation of a face

/// Distance along a ray to a triangle (Moeller and Trumbore); none if the ray misses it.
std::optional<double> meets(const Point& from, const Point& along, const std::array<Point, 3>& corners) {
  const Point a = minus(corners[1], corners[0]), b = minus(corners[2], corners[0]), p = cross(along, b);
  const double det = dot(a, p);
  if (det == 0.0) return {};
  const Point way = minus(from, corners[0]);
  const double u = dot(way, p) / det;
  if (!(u >= 0.0 && u <= 1.0)) return {};
  const Point q = cross(way, a);
  const double v = dot(along, q) / det;
  if (!(v >= 0.0 && u + v <= 1.0)) return {};
  const double distance = dot(b, q) / det;
  if (!(distance > 0.0)) return {};
  return distance;
}

}  // namespace

Skin::Triangle Skin::triangle(const std::array<Point, 3>& corners, const std::array<std::size_t, 3>& nodes, int face) {
  Triangle made{corners, nodes, face, {0, 0, 0}, {0, 0, 0}, 0.0};
  made.centre = scaled(1.0 / 3, plus(plus(corners[0], corners[1]), corners[2]));
  const Point normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const double length = norm(normal);
  made.area = length / 2;
  if (length > 0) made.normal = scaled(1.0 / length, normal);
  return made;
}

Skin::Skin(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  low_ = {1e300, 1e300, 1e300};
  high_ = {-1e300, -1e300, -1e300};
  for (const Triangle& triangle : triangles_) {
    area_ += triangle.area;
    for (const Point& corner : triangle.corners)
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], corner[k]);
        high_[k] = std::max(high_[k], corner[k]);
      }
  }
  turnOutward();
}

double Skin::extent() const { return triangles_.empty() ? 0.0 : norm(minus(high_, low_)); }

double Skin::volume() const {
  double sum = 0.0;
  for (const Triangle& triangle : triangles_) sum += triangle.area * dot(triangle.normal, minus(triangle.centre, low_)) / 3;
  return sum;
}

template <typename Visit>
void Skin::cast(const Point& from, const Point& along, std::size_t without, const Visit& visit) const {
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (i != without)
      if (const auto distance = meets(from, along, triangles_[i].corners)) visit(*distance, triangles_[i]);
}

// A ray that leaves a body meets its boundary an even number of times.
void Skin::turnOutward() {
  std::map<int, std::vector<std::size_t>> faces;
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (triangles_[i].area > 0) faces[triangles_[i].face].push_back(i);
  for (auto& [face, members] : faces) {
    std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) { return triangles_[a].area > triangles_[b].area; });
    std::size_t inward = 0;
    const std::size_t votes = std::min(kVotes, members.size());
    for (std::size_t vote = 0; vote < votes; ++vote) {
      const Triangle& triangle = triangles_[members[vote]];
      // Oblique, so that the ray hardly ever meets an edge of a symmetric body.
      const Point edge = minus(triangle.corners[1], triangle.corners[0]);
      const Point along = plus(triangle.normal, scaled(0.1234567 / norm(edge), plus(edge, scaled(0.321, cross(edge, triangle.normal)))));
      std::size_t hits = 0;
      cast(triangle.centre, along, members[vote], [&](double, const Triangle&) { ++hits; });
      inward += hits % 2;
    }
    if (2 * inward <= votes) continue;
    for (const std::size_t i : members) {
      std::swap(triangles_[i].corners[1], triangles_[i].corners[2]);
      std::swap(triangles_[i].nodes[1], triangles_[i].nodes[2]);
      triangles_[i].normal = scaled(-1.0, triangles_[i].normal);
    }
  }
}

std::optional<double> Skin::thicknessAt(std::size_t triangle) const {
  const Triangle& own = triangles_[triangle];
  const Point inward = scaled(-1.0, own.normal);
  std::optional<double> least;
  const Triangle* opposite = nullptr;
  cast(own.centre, inward, triangle, [&](double distance, const Triangle& other) {
    if (least && *least <= distance) return;
    least = distance;
    opposite = &other;
  });
  if (!opposite || dot(opposite->normal, own.normal) > -kParallel) return {};
  return least;
}

}  // namespace suture
