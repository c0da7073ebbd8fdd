#include <suture/constraints/pairing/MortarSampling.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

using Segment = MortarSegment;
using Geometry = ContactLine::Geometry;

constexpr double kOpposite = 1e-9;  // sine of the angle up to which two sides are parallel

}  // namespace

MortarSampling::MortarSampling(const Mesh& mesh, const ContactLine& line, bool onA)
    : mesh_(mesh),
      contact_(line),
      share_(onA ? line.shareOfA() : 1 - line.shareOfA()),
      own_(segments(onA ? line.groupA : line.groupB)),
      other_(segments(onA ? line.groupB : line.groupA)),
      segmentation_(other_),
      rule_(gaussRule(6)) {}

bool MortarSampling::isCurved() const {
  const auto curved = [](const Segment& s) { return s.isCurved(); };
  return std::any_of(own_.begin(), own_.end(), curved) || std::any_of(other_.begin(), other_.end(), curved);
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
  const auto met = segmentation_.nearest(from, normal);
  if (!met) return normal;
  const Point facing = met->other->normalAt(met->eta);
  return norm(cross(normal, facing)) > kOpposite ? unit(minus(normal, facing)) : normal;
}

MortarSampling::Samples MortarSampling::sample(const Segment& own, const Point& normal) const {
  Samples result;
  for (const Segmentation::Overlap& overlap : segmentation_.overlaps(own, normal)) {
    const double half = (overlap.end - overlap.begin) / 2, middle = (overlap.begin + overlap.end) / 2;
    const Segment& other = *overlap.other;
    result.covered += half;
    for (int q = 0; q < rule_.points.size(); ++q) {
      const double xi = middle + half * rule_.points(q);
      const Point from = own.at(xi);
      const auto met = Segmentation::meet(from, normal, other);
      if (!met) continue;  // beyond the element's end by rounding of its curve: of no weight
      Sample point{xi, half * rule_.weights(q) * norm(own.tangent(xi)), met->gap, 0, &other, met->eta};
      if (mesh_.axisymmetric) point.weight *= circumference(from[0]);
      if (contact_.initialGap)
        point.gap = contact_.initialGap->at(from);
      else {
        const Nearer smooth = nearer(own, xi, other, met->eta, normal);
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
