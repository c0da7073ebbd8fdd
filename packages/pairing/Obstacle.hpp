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

/// A rigid obstacle that fills a part of the plane or of space: the partner of side A of a contact instead of a second body.
class Obstacle {
 public:
  /// Foot of a point on the obstacle.
  struct Foot {
    Point normal{0, 0, 0};  ///< unit, into the obstacle
    double gap = 0.0;       ///< way to its surface along the normal; negative inside [length]
  };
  explicit Obstacle(std::function<Foot(const Point&)> foot) : foot_(std::move(foot)) {}
  /// A half-space, in the plane a half-plane, with this point on its surface. \param outward  out of it, towards the body, of any length
  /// but zero
  static Obstacle plane(const Point& through, const Point& outward);
  static Obstacle line(const Point& through, const Point& outward) { return plane(through, outward); }
  /// A ball, in the plane a disc, or all but that. \param hollow  the body is inside
  static Obstacle ball(const Point& centre, double radius, bool hollow = false);
  static Obstacle circle(const Point& centre, double radius, bool hollow = false) { return ball(centre, radius, hollow); }
  /// An endless cylinder, or all but that. \param axis  its direction, of any length but zero
  static Obstacle cylinder(const Point& through, const Point& axis, double radius, bool hollow = false);

  /// \throws InputError  an expression without a finite value there. Local.
  Foot from(const Point& point) const { return foot_(point); }
  /// Way from a point along a direction to the surface, negative where this is behind; nothing where the direction leads past it. By
  /// Newton's method on the gap. \param direction  a unit vector. \throws InputError  as from(). Local. [length]
  std::optional<double> way(const Point& point, const Point& direction) const;

  /// Values of the parameter `Obstacle` of a contact: None; in the plane Line, a half-plane, and Circle, a disc or the outside of one; in
  /// space Plane, Ball and Cylinder; Height, what lies below (or above) the graph of a function of x, in space of x and y. On a graph the
  /// condition is linear in the displacement of the point (x, y): y + u_y >= h(x) + h'(x) u_x, divided by sqrt(1 + h'^2); with Direction =
  /// Vertical without the term h' u_x, and undivided; likewise in space.
  static std::map<std::string, Schema> choices();
  /// The obstacle of an entry of `Contact`, or nothing. \param problems  gets an obstacle of another dimension, a direction of no length, a
  /// bad expression
  static std::optional<Obstacle> read(const Parameters& contact, int dimension, const Constants& constants, Problems& problems);

 private:
  std::function<Foot(const Point&)> foot_;
};

}  // namespace suture
