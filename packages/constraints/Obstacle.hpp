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

/// A rigid obstacle that fills a part of the plane: the partner of side A of a contact line instead of a second body.
class Obstacle {
 public:
  /// Foot of a point on the obstacle.
  struct Foot {
    Point normal{0, 0, 0};  ///< unit, into the obstacle
    double gap = 0.0;       ///< way to its surface along the normal; negative inside [length]
  };
  explicit Obstacle(std::function<Foot(const Point&)> foot) : foot_(std::move(foot)) {}
  /// A half-plane with this point on its surface. \param outward  out of it, towards the body, of any length but zero
  static Obstacle line(const Point& through, const Point& outward);
  /// A disc, or all but a disc. \param hollow  the body is inside the circle
  static Obstacle circle(const Point& centre, double radius, bool hollow = false);

  /// \throws InputError  an expression without a finite value there. Local.
  Foot from(const Point& point) const { return foot_(point); }

  /// Values of the parameter `Obstacle` of a contact line: None; Line, a half-plane; Circle, a disc or the outside of one; Height, what
  /// lies below (or above) the graph of a function of x. On a graph the condition is linear in the displacement of the point (x, y):
  /// y + u_y >= h(x) + h'(x) u_x, divided by sqrt(1 + h'^2); with Direction = Vertical without the term h' u_x, and undivided.
  static std::map<std::string, Schema> choices();
  /// The obstacle of an entry of `Contact`, or nothing. \param problems  gets a direction of no length, a bad expression
  static std::optional<Obstacle> read(const Parameters& contact, const Constants& constants, Problems& problems);

 private:
  std::function<Foot(const Point&)> foot_;
};

}  // namespace suture
