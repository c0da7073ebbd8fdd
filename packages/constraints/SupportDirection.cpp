#include <suture/base/Point.hpp>
#include <suture/constraints/SupportDirection.hpp>

#include <cmath>

namespace suture {

namespace {

constexpr double kOnAxis = 1e-9;  // distance from the axis, relative to that from its point, at which there is no radius

}  // namespace

std::optional<Point> SupportDirection::at(const Point& place) const {
  const Point axis = scaled(1.0 / norm(vector), vector);
  if (along == Along::Direction) return unit(axis);
  const Point away = minus(place, origin), radius = minus(away, scaled(dot(away, axis), axis));
  if (norm(radius) <= kOnAxis * norm(away)) return std::nullopt;
  return unit(along == Along::Radius ? radius : cross(axis, radius));
}

const std::vector<std::string>& SupportDirection::names() {
  static const std::vector<std::string> all{"Direction", "Radius", "Circumference"};
  return all;
}

}  // namespace suture
