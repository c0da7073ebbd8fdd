#include <suture/pairs/mortar/Segmentation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kSamePlace = 1e-10;  // relative to a side's reference interval
constexpr double kFacing = 0.5;       // cosine of the angle up to which two normals are opposite
constexpr double kAlong = 1e-6;       // cosine of the angle between a normal and a line up to which the line does not cross
constexpr double kRoundedValue =
    1e-14;  // value of a function that is round-off of coordinates, relative to its values at the ends of a side
constexpr double kRoundedPlace = 2e-16;  // reference coordinates that are the same
constexpr double kBetween = 1e-9;        // fraction of a distance at both of its ends where a side does not count as between them

/// Zero of a function on [-1, 1] that changes its sign there; nothing if it does not change sign. Regula falsi with the weights of the
/// Illinois variant: one step for the linear functions of straight sides.
template <typename Function>
std::optional<double> zeroOf(const Function& f) {
  double low = -1, high = 1, atLow = f(low), atHigh = f(high);
  if (atLow == 0) return low;
  if (atHigh == 0) return high;
  if ((atLow > 0) == (atHigh > 0)) return std::nullopt;
  const double rounded = kRoundedValue * std::max(std::abs(atLow), std::abs(atHigh));
  for (int last = 0; high - low > kRoundedPlace;) {
    const double secant = (low * atHigh - high * atLow) / (atHigh - atLow), middle = (low + high) / 2;
    const double place = secant > low && secant < high ? secant : middle, value = f(place);
    if (std::abs(value) <= rounded) return place;
    const int side = (value > 0) == (atLow > 0) ? -1 : 1;
    (side < 0 ? low : high) = place;
    (side < 0 ? atLow : atHigh) = value;
    if (side == last) (side < 0 ? atHigh : atLow) /= 2;
    last = side;
  }
  return (low + high) / 2;
}

// A line that meets a side separates its end points, so the end points suffice for the search.
std::vector<std::vector<Point>> endsOf(const std::vector<MortarSegment>& sides) {
  std::vector<std::vector<Point>> ends;
  for (const MortarSegment& side : sides) ends.push_back({side.end(0), side.end(1)});
  return ends;
}

/// Reference coordinate at which a line meets a side; nothing if it misses the side.
std::optional<double> placeOn(const MortarSegment& side, const Point& from, const Point& direction) {
  return zeroOf([&](double t) { return cross(minus(side.at(t), from), direction)[2]; });
}

/// Outward normal of a side.
Point normalAt(const MortarSegment& side, double eta) {
  const Point tangent = side.tangent(eta);
  return unit({tangent[1], -tangent[0], 0});
}

}  // namespace

Segmentation::Segmentation(const std::vector<MortarSegment>& others, double reach)
    : others_(others), reach_(reach), search_(endsOf(others)) {}

std::optional<Segmentation::Meeting> Segmentation::meet(const Point& from, const Point& direction, const MortarSegment& other) {
  const auto eta = placeOn(other, from, direction);
  if (!eta || dot(normalAt(other, *eta), direction) > -kFacing) return std::nullopt;
  return Meeting{&other, *eta, dot(minus(other.at(*eta), from), direction)};
}

/// True if the line from a side behind `from` to `from` leaves that side's body on the way: there is no interference, the bodies lie next
/// to each other, and the line has met the far side of one.
bool Segmentation::isThrough(const Meeting& met, const Point& from, const Point& direction, const std::vector<int>& candidates) const {
  if (met.gap >= 0.0) return false;
  return std::any_of(candidates.begin(), candidates.end(), [&](int i) {
    if (others_[i].body() != met.other->body()) return false;
    const auto eta = placeOn(others_[i], from, direction);
    if (!eta || dot(normalAt(others_[i], *eta), direction) < kAlong) return false;
    const double way = dot(minus(others_[i].at(*eta), from), direction);
    return way < kBetween * met.gap && way > (1 - kBetween) * met.gap;
  });
}

/// Sides of other bodies that lines through a side's nodes may meet.
std::vector<int> Segmentation::candidates(const std::vector<Point>& nodes, const Point& direction, int body) const {
  std::vector<int> found = search_.along(nodes, direction);
  found.erase(std::remove_if(found.begin(), found.end(), [&](int i) { return others_[i].body() == body; }), found.end());
  return found;
}

std::optional<Segmentation::Meeting> Segmentation::nearest(const Point& from, const Point& direction, int body, double beyond) const {
  const auto direct = nearest(from, direction, candidates({from}, direction, body));
  if (direct || beyond == 0.0) return direct;
  const Point aside{-beyond * direction[1], beyond * direction[0], 0};
  const std::vector<int> near = candidates({plus(from, aside), minus(from, aside)}, direction, body);
  std::optional<Meeting> best;
  double least = beyond;
  for (const int i : near)
    for (int end = 0; end < 2; ++end) {
      const Point way = minus(others_[i].end(end), from);
      const double away = std::abs(cross(way, direction)[2]), eta = end == 0 ? -1.0 : 1.0;
      const Meeting met{&others_[i], eta, dot(way, direction)};
      if (away > least || std::abs(met.gap) > reach_ || dot(normalAt(others_[i], eta), direction) > -kFacing) continue;
      if (isThrough(met, from, direction, near)) continue;
      least = away;
      best = met;
    }
  return best;
}

std::optional<Segmentation::Meeting> Segmentation::nearest(const Point& from, const Point& direction,
                                                           const std::vector<int>& candidates) const {
  std::optional<Meeting> best;
  double least = std::numeric_limits<double>::infinity();
  for (const int i : candidates)
    if (const auto met = meet(from, direction, others_[i]);
        met && std::abs(met->gap) <= reach_ && std::abs(met->gap) < least && !isThrough(*met, from, direction, candidates)) {
      least = std::abs(met->gap);
      best = met;
    }
  return best;
}

/// Reference coordinates where sides of the other surface begin or end, and both ends of the side itself.
std::vector<double> Segmentation::breaks(const MortarSegment& own, const Point& direction, const std::vector<int>& candidates) const {
  std::vector<double> all{-1, 1};
  for (const int i : candidates)
    for (int end = 0; end < 2; ++end)
      if (const auto xi = zeroOf([&](double t) { return cross(minus(others_[i].end(end), own.at(t)), direction)[2]; })) all.push_back(*xi);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < kSamePlace; }), all.end());
  if (1 - all.back() < kSamePlace) all.back() = 1;
  return all;
}

std::vector<Segmentation::Overlap> Segmentation::overlaps(const MortarSegment& own, const Point& direction) const {
  const std::vector<int> opposite = candidates(own.points(), direction, own.body());
  const std::vector<double> at = breaks(own, direction, opposite);
  std::vector<Overlap> found;
  for (std::size_t s = 0; s + 1 < at.size(); ++s)
    if (const auto met = nearest(own.at((at[s] + at[s + 1]) / 2), direction, opposite)) found.push_back({at[s], at[s + 1], met->other});
  return found;
}

}  // namespace suture
