#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/pairs/Obstacle.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kGrazing = 1e-3;   // cosine of the angle between a direction and the normal below which the direction misses the obstacle
constexpr double kArrived = 1e-14;  // last step of Newton's method, relative to the distance and the coordinates
constexpr int kMostSteps = 60;

/// Reads the sublist of one obstacle.
class ObstacleList {
 public:
  ObstacleList(const Parameters& list, int dimension, const Constants& constants, Problems& problems)
      : list_(list), dimension_(dimension), constants_(constants), problems_(problems) {}

  std::optional<Obstacle> plane() const {
    const Point through = point("Point"), outward = point("Normal");
    if (!hasLength("Normal", outward, "the direction out of the obstacle, towards the body")) return std::nullopt;
    return Obstacle::plane(through, outward);
  }

  std::optional<Obstacle> ball() const {
    const Point centre = point("Centre");
    if (!problems_.empty()) return std::nullopt;
    return Obstacle::ball(centre, list_.get<double>("Radius"), list_.get<bool>("Hollow"));
  }

  std::optional<Obstacle> cylinder() const {
    const Point through = point("Point"), axis = point("Axis");
    if (!hasLength("Axis", axis, "the direction of the axis")) return std::nullopt;
    return Obstacle::cylinder(through, axis, list_.get<double>("Radius"), list_.get<bool>("Hollow"));
  }

  std::optional<Obstacle> height() const {
    const std::optional<Expression> height = readExpression(list_, "Expression", constants_, problems_);
    if (!height) return std::nullopt;
    const bool vertical = list_.get<std::string>("Direction") == "Vertical";
    const double up = list_.get<bool>("Body Below") ? -1.0 : 1.0;
    const int last = dimension_ - 1;
    return Obstacle([=](const Point& point) {
      Point base = point, normal{0, 0, 0};
      base[last] = 0;
      normal[last] = -up;
      const double gap = up * (point[last] - height->at(base));
      if (vertical) return Obstacle::Foot{normal, gap};
      for (int k = 0; k < last; ++k) normal[k] = up * slopeOf(*height, base, k);
      return Obstacle::Foot{unit(normal), gap / norm(normal)};
    });
  }

 private:
  Point point(const std::string& name) const {
    const auto& values = list_.get<Teuchos::Array<double>>(name);
    Point point{0, 0, 0};
    if (int(values.size()) == dimension_)
      std::copy(values.begin(), values.end(), point.begin());
    else
      problems_.add(pathOf(list_, name),
                    "found " + std::to_string(values.size()) + " numbers; expected " +
                        (dimension_ == 2 ? "two, x and y, as in {0.0, 1.0}" : "three, x, y and z, as in {0.0, 0.0, 1.0}"));
    return point;
  }

  bool hasLength(const std::string& name, const Point& direction, const std::string& expected) const {
    if (problems_.empty() && norm(direction) == 0) problems_.add(pathOf(list_, name), "has no length; expected " + expected);
    return problems_.empty();
  }

  // Central differences of fourth order. The step balances truncation and round-off: eps^(1/5) of the scale.
  static double slopeOf(const Expression& height, const Point& base, int k) {
    const double h = 7.4e-4 * std::max(1.0, std::abs(base[k]));
    const auto at = [&](double steps) {
      Point place = base;
      place[k] += steps * h;
      return height.at(place);
    };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  }

  const Parameters& list_;
  int dimension_;
  const Constants& constants_;
  Problems& problems_;
};

}  // namespace

Obstacle Obstacle::plane(const Point& through, const Point& outward) {
  const Point into = unit(scaled(-1, outward));
  return Obstacle([=](const Point& point) { return Foot{into, dot(minus(through, point), into)}; });
}

Obstacle Obstacle::ball(const Point& centre, double radius, bool hollow) {
  const double sign = hollow ? -1.0 : 1.0;
  return Obstacle([=](const Point& point) {
    const Point way = minus(centre, point);
    const double distance = norm(way);
    if (distance == 0) return Foot{{0, -1, 0}, -sign * radius};
    return Foot{unit(scaled(sign, way)), sign * (distance - radius)};
  });
}

Obstacle Obstacle::cylinder(const Point& through, const Point& axis, double radius, bool hollow) {
  const Point along = scaled(1 / norm(axis), axis);
  const Obstacle circle = ball({0, 0, 0}, radius, hollow);
  return Obstacle([=](const Point& point) {
    const Point arm = minus(point, through);
    return circle.from(minus(arm, scaled(dot(arm, along), along)));
  });
}

std::optional<double> Obstacle::way(const Point& point, const Point& direction) const {
  double way = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Foot foot = from(plus(point, scaled(way, direction)));
    const double approach = dot(foot.normal, direction);
    if (!(approach > kGrazing)) return std::nullopt;
    const double more = foot.gap / approach;
    way += more;
    if (std::abs(more) <= kArrived * (std::abs(way) + norm(point))) return way;
  }
  return std::nullopt;
}

std::map<std::string, Schema> Obstacle::choices() {
  const auto flat = [](const std::string& what, const std::string& place) {
    return Schema(what)
        .reals("Point", std::nullopt, "a point on its surface: " + place, "length")
        .reals("Normal", std::nullopt, "out of the obstacle, towards the body; of any length");
  };
  const auto round = [](const std::string& what, const std::string& place, const std::string& name, const std::string& inside) {
    return Schema(what)
        .reals("Centre", std::nullopt, place, "length")
        .real("Radius", std::nullopt, "radius of the " + name, Range::positive(), "length")
        .boolean("Hollow", false, inside);
  };
  return {
      {"None", Schema("the partner is Side B")},
      {"Line", flat("a half-plane", "x, y")},
      {"Plane", flat("a half-space", "x, y, z")},
      {"Circle", round("a disc, or its exterior", "x, y", "disc", "true: the body is inside the circle, and the obstacle outside")},
      {"Ball", round("a ball, or its exterior", "x, y, z", "ball", "true: the body is inside the sphere, and the obstacle outside")},
      {"Cylinder", Schema("an infinite cylinder, or its exterior")
                       .reals("Point", std::nullopt, "a point on its axis: x, y, z", "length")
                       .reals("Axis", std::nullopt, "direction of the axis, of any length")
                       .real("Radius", std::nullopt, "radius of the cylinder", Range::positive(), "length")
                       .boolean("Hollow", false, "true: the body is inside the cylinder, and the obstacle outside")},
      {"Height", Schema("the region below the graph of a function")
                     .text("Expression", std::nullopt, "height y of the surface, a function of x; in 3D height z, a function of x and y")
                     .boolean("Body Below", false, "true: the body is below the graph, and the obstacle above it")
                     .oneOf("Direction", "Normal", {"Normal", "Vertical"},
                            "direction in which contact acts: the normal of the graph above or below the node, or y (3D: z)")}};
}

std::optional<Obstacle> Obstacle::read(const Parameters& contact, int dimension, const Constants& constants, Problems& problems) {
  const std::string type = contact.get<std::string>("Obstacle");
  if (type == "None") return std::nullopt;
  const bool flat = type == "Line" || type == "Circle", inSpace = type == "Plane" || type == "Ball" || type == "Cylinder";
  if (dimension == 2 ? inSpace : flat) {
    problems.add(
        pathOf(contact, "Obstacle"),
        "'" + type + (dimension == 2 ? "' is 3D; expected Line, Circle or Height" : "' is 2D; expected Plane, Ball, Cylinder or Height"));
    return std::nullopt;
  }
  Problems own;
  const ObstacleList list(contact.sublist(type), dimension, constants, own);
  auto obstacle = type == "Line" || type == "Plane"    ? list.plane()
                  : type == "Circle" || type == "Ball" ? list.ball()
                  : type == "Cylinder"                 ? list.cylinder()
                                                       : list.height();
  for (const auto& [path, what] : own.list()) problems.add(path, what);
  return obstacle;
}

}  // namespace suture
