#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/LineSampling.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

using Segment = MortarSegment;
using Geometry = ContactSurface::Geometry;

/// Sets the change of curvature along each second-order element: the smaller of the differences to its neighbours, which is zero next to
/// the joint of a line and an arc.
void findChanges(const Surface& surface, std::vector<Segment>& all) {
  for (int side = 0; side < surface.sides(); ++side) {
    Segment& segment = all[side];
    if (segment.isLinear() || segment.isStraight()) continue;
    const auto difference = [&](int facet, double sign) -> std::optional<double> {
      const int neighbour = surface.across(side, facet).side;
      if (neighbour < 0) return std::nullopt;
      const Segment& other = all[neighbour];
      return sign * (other.ownCurvature() - segment.ownCurvature()) * 2 * segment.length() / (segment.length() + other.length());
    };
    const auto before = difference(0, -1), after = difference(1, 1);
    if (before && after)
      segment.setChange(*before * *after <= 0 ? 0.0 : std::abs(*before) < std::abs(*after) ? *before : *after);
    else
      segment.setChange(before.value_or(after.value_or(0.0)));
  }
}

std::vector<Segment> segmentsOf(const Mesh& mesh, const ContactSurface& contact, bool onA) {
  const Surface& surface = *(onA ? contact.a : contact.b).surface;
  const BoundaryCurve curve(surface);
  std::vector<Segment> all;
  for (int side = 0; side < surface.sides(); ++side)
    all.emplace_back(surface, side, curve.bend(side), contact.sideOfBody(mesh.bodyOfNode[surface.nodesOf(side)[0]], onA));
  findChanges(surface, all);
  return all;
}

}  // namespace

LineSampling::LineSampling(const Mesh& mesh, const ContactSurface& contact, bool onA)
    : mesh_(mesh),
      contact_(contact),
      surface_(*(onA ? contact.a : contact.b).surface),
      rim_(rimOf(surface_)),
      share_(onA ? contact.shareOfA() : 1 - contact.shareOfA()),
      own_(segmentsOf(mesh, contact, onA)),
      other_(segmentsOf(mesh, contact, !onA)),
      segmentation_(other_, contact.reach),
      rule_(gaussRule(6)) {}

bool LineSampling::isFaceted() const {
  const auto curved = [](const Segment& s) { return s.isCurved(); };
  return (own_.front().isLinear() || other_.front().isLinear()) &&
         (std::any_of(own_.begin(), own_.end(), curved) || std::any_of(other_.begin(), other_.end(), curved));
}

// Distance by which the smooth sides are closer than their elements at a point of both, and its estimated error.
LineSampling::Nearer LineSampling::nearer(const Segment& own, double xi, const Segment& other, double eta, const Point& normal) const {
  Nearer result;
  const Point back{-normal[0], -normal[1], 0};
  const double mine = own.curvature(xi), its = other.curvature(eta);
  // Straight two-node elements stay straight. They approximate the shape of the sides in contact, which is one curve.
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

Point LineSampling::rowNormal(int side, int node) const {
  const Segment& own = own_[side];
  const Point &normal = own.normal(node), from = own.point(node);
  const auto met = segmentation_.nearest(from, normal, own.body(), (1 - MortarSamples::kReach) * own.length());
  if (!met) return normal;
  const auto rim = rim_.find(surface_.nodesOf(side)[node]);
  return rowNormalOf(normal, met->other->normalAt(met->eta), rim == rim_.end() ? nullptr : &rim->second);
}

MortarSamples LineSampling::sample(int side, const Point& normal) const {
  const Segment& own = own_[side];
  MortarSamples result;
  for (const Segmentation::Overlap& overlap : segmentation_.overlaps(own, normal)) {
    const double half = (overlap.end - overlap.begin) / 2, middle = (overlap.begin + overlap.end) / 2;
    const Segment& other = *overlap.other;
    result.covered += half;
    result.reach[0] = std::max(result.reach[0], (1 - overlap.begin) / 2);
    result.reach[1] = std::max(result.reach[1], (1 + overlap.end) / 2);
    for (int q = 0; q < rule_.points.size(); ++q) {
      const double xi = middle + half * rule_.points(q);
      const Point from = own.at(xi);
      const auto met = Segmentation::meet(from, normal, other);
      if (!met) continue;  // beyond the element's end due to round-off of its curve: negligible weight
      MortarSample point{
          {xi, 0, 0}, half * rule_.weights(q) * norm(own.tangent(xi)), met->gap, 0, static_cast<int>(&other - other_.data())};
      point.own = sideValues(own.count(), 2, point.at);
      point.others = sideValues(other.count(), 2, {met->eta, 0, 0});
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
