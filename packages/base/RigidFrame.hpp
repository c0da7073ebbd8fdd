#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// Centre and radius for the rigid motions of a set of points. A motion is given by amplitudes: translations along the axes, then rotations
/// about the centre (one in 2D, three in 3D), measured by the displacement that they cause at the distance `radius`. All amplitudes are
/// lengths, which makes them independent of units.
struct RigidFrame {
  Point centre{0, 0, 0};
  double radius = 1.0;  ///< [length]

  /// Mean of the points, and the largest distance from it; the radius of a single point is 1.
  static RigidFrame around(const std::vector<Point>& points);

  /// Position relative to the centre, in radii.
  Point arm(const Point& point) const;
  /// Displacement at a point for unit amplitudes: dimension x rigidMotions().
  Matrix at(const Point& point, int dimension) const;
};

}  // namespace suture
