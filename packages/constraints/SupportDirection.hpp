#pragma once
#include <suture/base/Types.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Direction of the only component that a Displacement with `Direction` or `Along` prescribes: constant, or radial or tangential about an
/// axis.
struct SupportDirection {
  enum class Along { Direction, Radius, Circumference };
  Along along = Along::Direction;
  Point vector{0, 0, 1};  ///< the direction, or that of the axis, in 2D perpendicular to the plane; of any length, not zero
  Point origin{0, 0, 0};  ///< a point of the axis [length]

  /// Unit vector at a position; none on the axis, where neither radius nor circumference has a direction. Local.
  std::optional<Point> at(const Point& place) const;

  /// Values of `Along`.
  static const std::vector<std::string>& names();
};

}  // namespace suture
