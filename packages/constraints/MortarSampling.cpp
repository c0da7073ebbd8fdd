#include <suture/constraints/MortarSampling.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace suture {

namespace {

using Segment = MortarSegment;
using Geometry = ContactLine::Geometry;

constexpr double kSamePlace = 1e-10;  // relative to an element's reference interval
constexpr double kFacing = 0.5;       // cosine of the angle up to which two normals are opposite
constexpr double kOpposite = 1e-9;    // sine of the angle up to which two sides are parallel

/// Zero of a function on [-1, 1] that changes its sign there; nothing if it does not.
template <typename Function>
std::optional<double> zeroOf(const Function& f) {
  double low = -1, high = 1;
  const double atLow = f(low), atHigh = f(high);
  if (atLow == 0) return low;
  if (atHigh == 0) return high;
  if ((atLow > 0) == (atHigh > 0)) return std::nullopt;
  while (high - low > 1e-16) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    ((f(middle) > 0) == (atLow > 0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

MortarSampling::MortarSampling(const Mesh& mesh, const ContactLine& line, bool onA)
    : mesh_(mesh),
      contact_(line),
      share_(onA ? line.shareOfA() : 1 - line.shareOfA()),
      own_(segments(onA ? line.groupA : line.groupB)),
      other_(segments(onA ? line.groupB : line.groupA)),
      rule_(gaussRule(6)) {}

bool MortarSampling::isCurved() const {
  const auto curved = [](const Segment& s) { return s.isCurved(); };
  return std::any_of(own_.begin(), own_.end(), curved) || std::any_of(other_.begin(), other_.end(), curved);
}

/// Point where the normal at a point of the carrying side meets an element of the other, face to face.
std::optional<MortarSampling::Meeting> MortarSampling::meet(const Point& from, const Point& normal, const Segment& other) {
  const auto eta = zeroOf([&](double t) { return cross(minus(other.at(t), from), normal)[2]; });
  if (!eta) return std::nullopt;
  const Point tangent = other.tangent(*eta);
  if (dot(unit({tangent[1], -tangent[0], 0}), normal) > -kFacing) return std::nullopt;
  return Meeting{*eta, dot(minus(other.at(*eta), from), normal)};
}

std::vector<Segment> MortarSampling::segments(const std::string& group) const {
  const std::vector<Side>& sides = mesh_.sideGroups.at(group);
  const BoundaryLine line(mesh_, sides);
  const BoundaryCurve curve(mesh_, sides);
  std::vector<Segment> all;
  for (std::size_t s = 0; s < sides.size(); ++s) all.emplace_back(mesh_, line, mesh_.nodesOf(sides[s]), curve.bend(s));
  findChanges(all);
  return all;
}

/// Tells each second-order element how the curvature changes along it: from its neighbours' by the smaller of the two differences, which
/// sees no change beside the joint of a line and an arc.
void MortarSampling::findChanges(std::vector<Segment>& all) {
  std::map<int, std::size_t> beginning, ending;
  for (std::size_t s = 0; s < all.size(); ++s) beginning[all[s].nodes()[0]] = s, ending[all[s].nodes()[1]] = s;
  for (Segment& segment : all) {
    if (segment.isLinear() || segment.isStraight()) continue;
    const auto difference = [&](const std::map<int, std::size_t>& found, int node, double sign) -> std::optional<double> {
      const auto at = found.find(node);
      if (at == found.end()) return std::nullopt;
      const Segment& other = all[at->second];
      return sign * (other.ownCurvature() - segment.ownCurvature()) * 2 * segment.length() / (segment.length() + other.length());
    };
    const auto before = difference(ending, segment.nodes()[0], -1), after = difference(beginning, segment.nodes()[1], 1);
    if (before && after)
      segment.setChange(*before * *after <= 0 ? 0.0 : std::abs(*before) < std::abs(*after) ? *before : *after);
    else
      segment.setChange(before.value_or(after.value_or(0.0)));
  }
}

/// Reference coordinates where elements of the other side begin or end, seen along a normal, and the ends.
std::vector<double> MortarSampling::breaks(const Segment& own, const Point& normal) const {
  std::vector<double> all{-1, 1};
  for (const Segment& other : other_)
    for (int end = 0; end < 2; ++end)
      if (const auto xi = zeroOf([&](double t) { return cross(minus(other.end(end), own.at(t)), normal)[2]; })) all.push_back(*xi);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < kSamePlace; }), all.end());
  if (1 - all.back() < kSamePlace) all.back() = 1;
  return all;
}

const Segment* MortarSampling::nearest(const Point& from, const Point& normal) const {
  const Segment* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& other : other_)
    if (const auto met = meet(from, normal, other); met && std::abs(met->gap) < least) {
      least = std::abs(met->gap);
      best = &other;
    }
  return best;
}

// Distance by which the smooth sides are nearer than their elements at a point of both, and its estimated error.
MortarSampling::Nearer MortarSampling::nearer(const Segment& own, double xi, const Segment& other, double eta, const Point& normal) const {
  Nearer result;
  const Point back{-normal[0], -normal[1], 0};
  const double mine = own.curvature(xi), its = other.curvature(eta);
  // Straight elements of two nodes stay so. They approximate the shape of the sides in contact, which is one curve.
  const double common = contact_.geometry == Geometry::Smooth ? mine : (1 - share_) * mine - share_ * its;
  const double against = contact_.geometry == Geometry::Smooth ? its : -common;
  const auto add = [&](const Segment& segment, double drawn, double closed, double at, const Point& out) {
    if (!segment.isStraight()) {
      result.doubt += segment.awayFromCurve(at);
      return;
    }
    result.way += segment.wayToArc(segment.isLinear() ? closed : drawn, at, out);
    result.doubt += arcOver(segment.curvatureDoubt(), segment.length(), at).height;
  };
  add(own, mine, common, xi, normal);
  add(other, its, against, eta, back);
  return result;
}

Point MortarSampling::meanNormal(const Segment& own, int node) const {
  const Point &normal = own.normal(node), from = own.point(node);
  const Segment* other = nearest(from, normal);
  if (!other) return normal;
  const Point facing = other->normalAt(meet(from, normal, *other)->eta);
  return norm(cross(normal, facing)) > kOpposite ? unit(minus(normal, facing)) : normal;
}

MortarSampling::Samples MortarSampling::sample(const Segment& own, const Point& normal) const {
  Samples result;
  const std::vector<double> at = breaks(own, normal);
  for (std::size_t s = 0; s + 1 < at.size(); ++s) {
    const double half = (at[s + 1] - at[s]) / 2, middle = (at[s] + at[s + 1]) / 2;
    const Segment* other = nearest(own.at(middle), normal);
    if (!other) continue;
    result.covered += half;
    for (int q = 0; q < rule_.points.size(); ++q) {
      const double xi = middle + half * rule_.points(q);
      const Point from = own.at(xi);
      const auto met = meet(from, normal, *other);
      if (!met) continue;  // beyond the element's end by rounding of its curve: of no weight
      Sample point{xi, half * rule_.weights(q) * norm(own.tangent(xi)), met->gap, 0, other, met->eta};
      if (mesh_.axisymmetric) point.weight *= circumference(from[0]);
      if (contact_.initialGap)
        point.gap = contact_.initialGap->at(from);
      else {
        const Nearer smooth = nearer(own, xi, *other, met->eta, normal);
        if (contact_.geometry == Geometry::Facets)
          point.doubt = smooth.way;
        else
          point.gap -= smooth.way, point.doubt = smooth.doubt;
      }
      result.all.push_back(point);
    }
  }
  return result;
}

}  // namespace suture
