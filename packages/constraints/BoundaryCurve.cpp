#include <suture/constraints/BoundaryCurve.hpp>
#include <suture/constraints/BoundaryLine.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace suture {

namespace {

constexpr double kStraight = 1e-9;  // sine of the angle between chords, below which they are one line
constexpr double kAlike = 0.25;     // part of the larger curvature up to which a change along a side is smooth
const double kCornerAngle = 45.001 * 3.14159265358979323846 / 180;  // a ring of eight sides is still round

using Curvature = std::optional<double>;

Curvature curvatureBetween(const Point& before, const Point& after) {
  if (angleBetween(before, after) > kCornerAngle) return std::nullopt;
  const double a = norm(before), b = norm(after), turn = cross(before, after)[2];
  if (std::abs(turn) <= kStraight * a * b) return 0.0;
  const Point whole{before[0] + after[0], before[1] + after[1], 0};
  return 2 * turn / (a * b * norm(whole));
}

using Bend = BoundaryCurve::Bend;

/// Curvatures at four nodes that follow each other; the side lies between the second and the third.
Bend bendOf(Curvature first, Curvature second, Curvature third, Curvature fourth) {
  if (!second && !third) return {};
  if (!second) return {*third, *third, fourth ? *fourth - *third : 0.0};
  if (!third) return {*second, *second, first ? *first - *second : 0.0};
  const double left = *second, right = *third, change = right - left;
  // An unknown outer change is taken to be as the inner one.
  const double before = first ? left - *first : change, after = fourth ? *fourth - right : change;
  const double most = std::max({std::abs(before), std::abs(change), std::abs(after)});
  const bool alike = most <= kAlike * std::max(std::abs(left), std::abs(right));
  // Through an inflection the curvature may change by more than itself, but steadily.
  const bool steady = first && fourth && std::max({before, change, after}) - std::min({before, change, after}) <= most / 2;
  if (alike || steady) return {left, right, (after - before) / 2};
  // An end without outer neighbour is like one: the end of a line has the value of the node beside it.
  const double toFirst = first ? before : 0.0, toFourth = fourth ? after : 0.0;
  const auto agree = [&](double at, Curvature outer, double difference) {
    return std::abs(difference) <= kAlike * std::max(std::abs(at), std::abs(outer.value_or(at)));
  };
  const bool leftAgrees = agree(left, first, toFirst), rightAgrees = agree(right, fourth, toFourth);
  // The end whose neighbour is like it decides. If both ends have such a neighbour, or neither has, a straight end decides, because a line
  // goes on straight beside a chamfer and on a polygon. Failing that, the end of smaller change decides if both have such a neighbour, and
  // the more curved one if neither has: that is the middle of a fillet of two sides, whose other nodes are means of arc and line.
  bool takeLeft = leftAgrees;
  if (leftAgrees == rightAgrees) {
    const bool more = leftAgrees ? std::abs(toFirst) < std::abs(toFourth) : std::abs(left) > std::abs(right);
    takeLeft = left == 0 || (right != 0 && more);
  }
  return takeLeft ? Bend{left, left, toFirst} : Bend{right, right, toFourth};
}

}  // namespace

BoundaryCurve::BoundaryCurve(const CellBlock& block, const std::vector<Side>& sides) {
  std::vector<std::pair<int, int>> ends;
  std::map<int, int> next, previous;
  for (const Side& side : sides) {
    const std::vector<int> nodes = block.nodesOf(side);
    ends.push_back({nodes[0], nodes[1]});
    next.emplace(nodes[0], nodes[1]);
    previous.emplace(nodes[1], nodes[0]);
  }
  const auto follow = [](const std::map<int, int>& way, int node) {
    const auto found = way.find(node);
    return found == way.end() ? -1 : found->second;
  };
  const auto curvature = [&](int node) -> Curvature {
    const int from = node < 0 ? -1 : follow(previous, node), to = node < 0 ? -1 : follow(next, node);
    if (from < 0 || to < 0) return std::nullopt;
    return curvatureBetween(minus(block.point(node), block.point(from)), minus(block.point(to), block.point(node)));
  };
  for (const auto& [a, b] : ends) {
    // Nothing is seen across a corner.
    const Curvature atA = curvature(a), atB = curvature(b);
    bends_.push_back(
        bendOf(atA ? curvature(follow(previous, a)) : std::nullopt, atA, atB, atB ? curvature(follow(next, b)) : std::nullopt));
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
