#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/BoundaryCurve.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace suture {

namespace {

constexpr double kStraight = 1e-9;  // sine of the angle between chords below which they are collinear
constexpr double kAlike = 0.25;     // fraction of the larger curvature up to which a change along a side is smooth
const double kCornerAngle = 45.001 * 3.14159265358979323846 / 180;  // a ring of eight sides still counts as round

using Curvature = std::optional<double>;

Curvature curvatureBetween(const Point& before, const Point& after) {
  if (angleBetween(before, after) > kCornerAngle) return std::nullopt;
  const double a = norm(before), b = norm(after), turn = cross(before, after)[2];
  if (std::abs(turn) <= kStraight * a * b) return 0.0;
  const Point whole{before[0] + after[0], before[1] + after[1], 0};
  return 2 * turn / (a * b * norm(whole));
}

using Bend = BoundaryCurve::Bend;

/// Curvature along the side between the second and third of four successive nodes.
Bend bendOf(Curvature first, Curvature second, Curvature third, Curvature fourth) {
  if (!second && !third) return {};
  if (!second) return {*third, *third, fourth ? *fourth - *third : 0.0};
  if (!third) return {*second, *second, first ? *first - *second : 0.0};
  const double left = *second, right = *third, change = right - left;
  // An unknown outer change is assumed equal to the inner one.
  const double before = first ? left - *first : change, after = fourth ? *fourth - right : change;
  const double most = std::max({std::abs(before), std::abs(change), std::abs(after)});
  const bool alike = most <= kAlike * std::max(std::abs(left), std::abs(right));
  // At an inflection the curvature may change by more than its own magnitude, but steadily.
  const bool steady = first && fourth && std::max({before, change, after}) - std::min({before, change, after}) <= most / 2;
  if (alike || steady) return {left, right, (after - before) / 2};
  // An end without outer neighbour counts as agreeing: the end of a line has the value of the node next to it.
  const double toFirst = first ? before : 0.0, toFourth = fourth ? after : 0.0;
  const auto agree = [&](double at, Curvature outer, double difference) {
    return std::abs(difference) <= kAlike * std::max(std::abs(at), std::abs(outer.value_or(at)));
  };
  const bool leftAgrees = agree(left, first, toFirst), rightAgrees = agree(right, fourth, toFourth);
  // The end that agrees with its neighbour decides. If both or neither agree, a straight end decides, because a line continues straight
  // beside a chamfer and on a polygon. Otherwise the end with the smaller change decides if both agree, and the more curved one if neither
  // does: that is the middle of a fillet of two sides, whose other nodes are means of arc and line.
  bool takeLeft = leftAgrees;
  if (leftAgrees == rightAgrees) {
    const bool more = leftAgrees ? std::abs(toFirst) < std::abs(toFourth) : std::abs(left) > std::abs(right);
    takeLeft = left == 0 || (right != 0 && more);
  }
  return takeLeft ? Bend{left, left, toFirst} : Bend{right, right, toFourth};
}

}  // namespace

BoundaryCurve::BoundaryCurve(const Surface& surface) {
  if (surface.dimension() != 2) throw InternalError("BoundaryCurve needs a 2D surface");
  std::vector<Point> chords;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int>& nodes = surface.nodesOf(side);
    chords.push_back(minus(surface.at(nodes[1]).drawn, surface.at(nodes[0]).drawn));
  }
  const auto before = [&](int side) { return side < 0 ? -1 : surface.across(side, 0).side; };
  const auto after = [&](int side) { return side < 0 ? -1 : surface.across(side, 1).side; };
  const auto curvature = [&](int first, int second) -> Curvature {  // where two sides meet
    if (first < 0 || second < 0) return std::nullopt;
    return curvatureBetween(chords[first], chords[second]);
  };
  for (int side = 0; side < surface.sides(); ++side) {
    const int previous = before(side), next = after(side);
    // Neighbours across a corner are ignored.
    const Curvature atBegin = curvature(previous, side), atEnd = curvature(side, next);
    bends_.push_back(bendOf(atBegin ? curvature(before(previous), previous) : std::nullopt, atBegin, atEnd,
                            atEnd ? curvature(next, after(next)) : std::nullopt));
  }
}

Bulge arcOver(double curvature, double h, double xi) {
  if (curvature == 0) return {};
  const double u = xi * h / 2, sine = std::min(std::abs(curvature) * h / 2, 1.0);
  const double here = std::sqrt(std::max(0.0, 1 - curvature * curvature * u * u)), atEnd = std::sqrt(1 - sine * sine);
  if (here + atEnd == 0) return {};
  Bulge bulge;
  bulge.height = curvature * (h * h / 4 - u * u) / (here + atEnd);
  bulge.slope = -curvature * u / std::max(here, 1e-3);
  return bulge;
}

}  // namespace suture
