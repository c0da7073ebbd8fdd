#include <suture/base/Point.hpp>
#include <suture/reader/gmsh/SizesByPlace.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {
constexpr double kInside = 1e-6;  // barycentric coordinates above -kInside belong to points inside, or on a side
constexpr double kBeside = 0.2;   // likewise of points between a curved side and the chord of the simplex
}  // namespace

SizesByPlace::SizesByPlace(SizeField field, double scale) : field_(std::move(field)) {
  for (double& x : field_.points) x *= scale;
  for (double& size : field_.sizes) size *= scale;
  const int corners = field_.dimension + 1;
  std::vector<BoundingBox> boxes(field_.simplices.size() / static_cast<std::size_t>(corners)), points(field_.sizes.size());
  for (std::size_t s = 0; s < boxes.size(); ++s)
    for (int k = 0; k < corners; ++k) boxes[s].include(vertex(static_cast<int>(s), k));
  for (BoundingBox& box : boxes) {  // room for the points beside a curved side
    const double room = kBeside * norm(minus(box.high, box.low));
    for (int k = 0; k < field_.dimension; ++k) box.low[k] -= room, box.high[k] += room;
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v].include(Point{field_.points[3 * v], field_.points[3 * v + 1], field_.points[3 * v + 2]});
  simplices_.emplace(boxes);
  vertices_.emplace(points);
}

Point SizesByPlace::vertex(int simplex, int k) const {
  const double* x = field_.points.data() + 3 * field_.simplices[static_cast<std::size_t>(simplex) * (field_.dimension + 1) + k];
  return {x[0], x[1], x[2]};
}

bool SizesByPlace::coordinatesIn(int simplex, const Point& point, double* all) const {
  const Point origin = vertex(simplex, 0), x = minus(point, origin);
  const Point a = minus(vertex(simplex, 1), origin), b = minus(vertex(simplex, 2), origin);
  if (field_.dimension == 2) {
    const double area = a[0] * b[1] - a[1] * b[0];
    all[1] = (x[0] * b[1] - x[1] * b[0]) / area;
    all[2] = (a[0] * x[1] - a[1] * x[0]) / area;
    all[0] = 1 - all[1] - all[2];
    return std::isfinite(all[1]) && std::isfinite(all[2]);
  }
  const Point c = minus(vertex(simplex, 3), origin);
  const double volume = dot(a, cross(b, c));
  all[1] = dot(x, cross(b, c)) / volume;
  all[2] = dot(a, cross(x, c)) / volume;
  all[3] = dot(a, cross(b, x)) / volume;
  all[0] = 1 - all[1] - all[2] - all[3];
  return std::isfinite(all[1]) && std::isfinite(all[2]) && std::isfinite(all[3]);
}

double SizesByPlace::valueIn(int simplex, const double* coordinates) const {
  double value = 0, sum = 0;
  for (int k = 0; k <= field_.dimension; ++k) {
    const double share = std::max(coordinates[k], 0.0);
    value += share * field_.sizes[field_.simplices[static_cast<std::size_t>(simplex) * (field_.dimension + 1) + k]];
    sum += share;
  }
  return value / sum;
}

double SizesByPlace::at(const Point& point) const {
  double least = std::numeric_limits<double>::infinity(), beside = least, furthest = -kBeside;
  for (const int simplex : simplices_->find([&](const BoundingBox& box) { return box.distance(point) <= 0; })) {
    double coordinates[4];
    if (!coordinatesIn(simplex, point, coordinates)) continue;
    const double lowest = *std::min_element(coordinates, coordinates + field_.dimension + 1);
    if (lowest < furthest) continue;
    const double value = valueIn(simplex, coordinates);
    if (lowest >= -kInside)
      least = std::min(least, value);
    else
      furthest = lowest, beside = value;
  }
  if (std::isfinite(least)) return least;
  if (std::isfinite(beside)) return beside;
  const int nearest = vertices_->nearest(point, [&](int v) {
    const double* x = field_.points.data() + 3 * static_cast<std::size_t>(v);
    return norm(minus(point, Point{x[0], x[1], x[2]}));
  });
  return nearest < 0 ? least : field_.sizes[static_cast<std::size_t>(nearest)];
}

}  // namespace suture
