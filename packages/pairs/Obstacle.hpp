#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/Types.hpp>
#include <suture/base/scene/Schema.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace suture {

/// A rigid obstacle that fills part of the plane (2D) or of space (3D): the partner of side A of a contact, in place of a second body.
class Obstacle {
 public:
  /// Nearest point of the obstacle's surface, as seen from a point.
  struct Foot {
    Point normal{0, 0, 0};  ///< unit, into the obstacle
    double gap = 0.0;       ///< distance to the surface along the normal; negative inside the obstacle [length]
  };
  explicit Obstacle(std::function<Foot(const Point&)> foot) : foot_(std::move(foot)) {}
  /// A half-space (2D: half-plane) with this point on its surface. \param outward  out of the obstacle, towards the body; any non-zero
  /// length
  static Obstacle plane(const Point& through, const Point& outward);
  static Obstacle line(const Point& through, const Point& outward) { return plane(through, outward); }
  /// A ball (2D: disc), or its exterior. \param hollow  the body is inside
  static Obstacle ball(const Point& centre, double radius, bool hollow = false);
  static Obstacle circle(const Point& centre, double radius, bool hollow = false) { return ball(centre, radius, hollow); }
  /// An infinite cylinder, or its exterior. \param axis  its direction, any non-zero length
  static Obstacle cylinder(const Point& through, const Point& axis, double radius, bool hollow = false);

  /// False for the placeholder of an obstacle that could not be read.
  bool isSound() const { return foot_ != nullptr; }
  /// \throws InputError  if an expression has no finite value at the point. Local.
  Foot from(const Point& point) const { return foot_(point); }
  /// Signed distance from a point to the surface along a direction, negative if the surface is behind the point; nothing if the direction
  /// misses the surface. Solved by Newton's method on the gap. \param direction  a unit vector. \throws InputError  as from(). Local.
  /// [length]
  std::optional<double> way(const Point& point, const Point& direction) const;

  /// Values of the parameter `Obstacle` of a contact: None; in 2D Line, a half-plane, and Circle, a disc or its exterior; in 3D Plane, Ball
  /// and Cylinder; Height, the region below (or above) the graph of a function of x, in 3D of x and y. On a graph the condition is linear
  /// in the displacement of the point (x, y): y + u_y >= h(x) + h'(x) u_x, divided by sqrt(1 + h'^2); with Direction = Vertical without the
  /// term h' u_x and without the division; likewise in 3D.
  static std::map<std::string, Schema> choices();
  /// The obstacle of an entry of `Contact`, or nothing. \param problems  receives an obstacle of the wrong dimension, a direction of zero
  /// length, an invalid expression
  static std::optional<Obstacle> read(const Parameters& contact, int dimension, const Constants& constants, Problems& problems);

 private:
  std::function<Foot(const Point&)> foot_;
};

}  // namespace suture
