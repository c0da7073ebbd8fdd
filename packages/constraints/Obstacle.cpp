#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Obstacle.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <cmath>

namespace suture {

namespace {

Point pointIn(const Parameters& list, const std::string& name, Problems& problems) {
  const auto& values = list.get<Teuchos::Array<double>>(name);
  if (values.size() == 2) return {values[0], values[1], 0};
  problems.add(pathOf(list, name), "found " + std::to_string(values.size()) + " numbers; expected two, x and y, as in {0.0, 1.0}");
  return {0, 0, 0};
}

std::optional<Obstacle> lineIn(const Parameters& own, Problems& problems) {
  const Point through = pointIn(own, "Point", problems), outward = pointIn(own, "Normal", problems);
  if (!problems.empty()) return std::nullopt;
  if (norm(outward) == 0) {
    problems.add(pathOf(own, "Normal"), "has no length; expected the direction out of the obstacle, towards the body");
    return std::nullopt;
  }
  return Obstacle::line(through, outward);
}

std::optional<Obstacle> circleIn(const Parameters& own, Problems& problems) {
  const Point centre = pointIn(own, "Centre", problems);
  if (!problems.empty()) return std::nullopt;
  return Obstacle::circle(centre, own.get<double>("Radius"), own.get<bool>("Hollow"));
}

// By central differences of fourth order. The step balances their error with rounding: eps^(1/5) of the scale.
double slopeOf(const Expression& height, double x) {
  const double h = 7.4e-4 * std::max(1.0, std::abs(x));
  const auto at = [&](double steps) { return height.at({x + steps * h, 0, 0}); };
  return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
}

std::optional<Obstacle> heightIn(const Parameters& own, const Constants& constants, Problems& problems) {
  const std::optional<Expression> height = readExpression(own, "Expression", constants, problems);
  if (!height) return std::nullopt;
  const bool vertical = own.get<std::string>("Direction") == "Vertical";
  const double up = own.get<bool>("Body Below") ? -1.0 : 1.0;
  return Obstacle([=](const Point& point) {
    const double gap = up * (point[1] - height->at({point[0], 0, 0}));
    if (vertical) return Obstacle::Foot{{0, -up, 0}, gap};
    const double slope = slopeOf(*height, point[0]), length = std::hypot(1.0, slope);
    return Obstacle::Foot{unit({up * slope, -up, 0}), gap / length};
  });
}

}  // namespace

Obstacle Obstacle::line(const Point& through, const Point& outward) {
  const Point into = unit({-outward[0], -outward[1], 0});
  return Obstacle([=](const Point& point) { return Foot{into, dot(minus(through, point), into)}; });
}

Obstacle Obstacle::circle(const Point& centre, double radius, bool hollow) {
  const double sign = hollow ? -1.0 : 1.0;
  return Obstacle([=](const Point& point) {
    const Point way = minus(centre, point);
    const double distance = norm(way);
    if (distance == 0) return Foot{{0, -1, 0}, -sign * radius};
    return Foot{unit({sign * way[0], sign * way[1], 0}), sign * (distance - radius)};
  });
}

std::map<std::string, Schema> Obstacle::choices() {
  return {{"None", Schema("the partner is Side B, on another body")},
          {"Line", Schema("a half-plane")
                       .reals("Point", std::nullopt, "on its surface: x, y", "length")
                       .reals("Normal", std::nullopt, "out of the obstacle, towards the body; of any length")},
          {"Circle", Schema("a disc, or all but a disc")
                         .reals("Centre", std::nullopt, "x, y", "length")
                         .real("Radius", std::nullopt, "radius of the disc", Range::positive(), "length")
                         .boolean("Hollow", false, "whether the body is inside the circle, and the obstacle around it")},
          {"Height", Schema("what lies below the graph of a function")
                         .text("Expression", std::nullopt, "height y of the surface, a function of x")
                         .boolean("Body Below", false, "whether the body is below the graph, and the obstacle above it")
                         .oneOf("Direction", "Normal", {"Normal", "Vertical"},
                                "along which nodes are kept from crossing: the graph's normal above or below the node, or y")}};
}

std::optional<Obstacle> Obstacle::read(const Parameters& contact, const Constants& constants, Problems& problems) {
  const std::string type = contact.get<std::string>("Obstacle");
  if (type == "None") return std::nullopt;
  Problems own;
  const Parameters& list = contact.sublist(type);
  auto obstacle = type == "Line" ? lineIn(list, own) : type == "Circle" ? circleIn(list, own) : heightIn(list, constants, own);
  for (const auto& [path, what] : own.list()) problems.add(path, what);
  return obstacle;
}

}  // namespace suture
