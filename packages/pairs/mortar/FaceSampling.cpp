#include <suture/pairs/mortar/FaceSampling.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kAcross = 0.5;    // cosine of the angle up to which two normals are opposite
constexpr double kEdgeOn = 1e-6;   // cosine of the angle between a normal and a line up to which the line does not cross
constexpr double kSnap = 1e-12;    // distance of a corner from an edge up to which it lies on the edge, relative to the facet
constexpr double kRound = 1e-15;   // the same relative to the coordinates
constexpr double kBeyond = 1e-9;   // distance beyond an edge up to which a node counts as opposite to a facet, relative to the facet
constexpr double kWithin = 1e-9;   // fraction of a distance at both of its ends where a facet does not count as between them
constexpr double kLayered = 1e-9;  // area of intersections in excess of that of the facet, relative to it
constexpr int kCurvedDegree = 5, kMostDegree = 10;  // quadrature degrees: on curved faces, on distorted sides
constexpr double kDistorted = 1e-9;                 // relative size of the neglected terms of integrands

std::vector<MortarFace> facesOf(const Mesh& mesh, const ContactSurface& contact, bool onA) {
  const Surface& surface = *(onA ? contact.a : contact.b).surface;
  const std::map<int, Point> drawn = mesh.drawn.empty() ? std::map<int, Point>() : MortarFace::drawnNormals(surface);
  std::vector<MortarFace> all;
  for (int side = 0; side < surface.sides(); ++side)
    all.emplace_back(surface, side, contact.sideOfBody(mesh.bodyOfNode[surface.nodesOf(side)[0]], onA),
                     mesh.drawn.empty() ? nullptr : &drawn);
  return all;
}

/// For each side of a face, the first of the face's groups that contains it.
std::vector<int> groupsOf(const Mesh& mesh, const ContactFace& face) {
  std::map<std::pair<int, int>, int> groupOf;
  for (std::size_t group = 0; group < face.groups.size(); ++group)
    for (const Side& side : mesh.sideGroups.at(face.groups[group])) groupOf.emplace(std::make_pair(side.element, side.side), int(group));
  std::vector<int> all;
  for (const Side& side : sidesOf(mesh.sideGroups, face.groups)) all.push_back(groupOf.at({side.element, side.side}));
  return all;
}

std::vector<SmoothFace> smoothOf(const Mesh& mesh, const ContactFace& face, const std::vector<MortarFace>& sides) {
  const auto isCurved = [](const MortarFace& side) { return side.isCurved(); };
  std::vector<SmoothFace> all;
  if (cellInfo(sides.front().cell()).order == 1 && std::any_of(sides.begin(), sides.end(), isCurved)) {
    const BoundarySurface surface(*face.surface, groupsOf(mesh, face));
    for (std::size_t side = 0; side < sides.size(); ++side) all.emplace_back(sides[side], surface.jets(static_cast<int>(side)));
  } else {
    for (const MortarFace& side : sides) all.emplace_back(side, std::vector<BoundarySurface::Jet>{});
  }
  return all;
}

template <typename Facet>
std::vector<std::vector<Point>> pointsOf(const std::vector<Facet>& facets) {
  std::vector<std::vector<Point>> points;
  for (const Facet& facet : facets) points.push_back(facet.points);
  return points;
}

/// Degree of the shape functions of a side on its reference cell.
int degreeOf(Cell cell) {
  switch (cell) {
    case Cell::Triangle3:
      return 1;
    case Cell::Quadrilateral8:
      return 3;
    case Cell::Quadrilateral9:
      return 4;
    default:
      return 2;
  }
}

/// Quadrature degree over the intersection of two sides: shape functions times multiplier, as far as these are polynomials of the position.
/// On distorted quadrilaterals they are series whose terms of higher degree have powers of the distortion as factors. On curved faces the
/// element shape is the larger error.
int degreeOf(const MortarFace& own, const MortarFace& other, Contact::Multipliers multipliers) {
  if (own.isCurved() || other.isCurved()) return kCurvedDegree;
  const int multiplier = multipliers == Contact::Multipliers::Quadratic ? degreeOf(own.cell()) : own.vertices() - 2;
  const int degree = std::max(degreeOf(own.cell()), degreeOf(other.cell())) + multiplier;
  if (!own.isStraight() || !other.isStraight()) return kMostDegree;
  const double distortion = std::max(own.distortion(), other.distortion());
  if (distortion == 0) return degree;
  const double terms = distortion < 0.1 ? std::log(kDistorted) / std::log(distortion) : double(kMostDegree);
  return std::max(degree, std::min(kMostDegree, degree + static_cast<int>(std::ceil(terms)) - 1));
}

PlanePoint middleOf(const Polygon& polygon) {
  PlanePoint middle{0, 0};
  for (const PlanePoint& corner : polygon)
    for (int c = 0; c < 2; ++c) middle[c] += corner[c] / static_cast<double>(polygon.size());
  return middle;
}

Polygon part(const Polygon& polygon, const std::vector<int>& corners) {
  Polygon some;
  for (const int corner : corners) some.push_back(polygon[corner]);
  return some;
}

}  // namespace

std::vector<FaceSampling::Facet> FaceSampling::facetsOf(const std::vector<MortarFace>& sides) {
  std::vector<Facet> all;
  for (std::size_t side = 0; side < sides.size(); ++side)
    for (const std::vector<int>& nodes : sides[side].facets()) {
      Facet facet{static_cast<int>(side), {}, nodes, {0, 0, 0}};
      for (const int node : nodes) facet.points.push_back(sides[side].points()[node]);
      const std::vector<Point>& p = facet.points;
      facet.area = scaled(0.5, p.size() == 3 ? cross(minus(p[1], p[0]), minus(p[2], p[0])) : cross(minus(p[2], p[0]), minus(p[3], p[1])));
      all.push_back(std::move(facet));
    }
  return all;
}

FaceSampling::FaceSampling(const Mesh& mesh, const ContactSurface& contact, bool onA)
    : contact_(contact),
      surface_(*(onA ? contact.a : contact.b).surface),
      rim_(rimOf(surface_)),
      share_(onA ? contact.shareOfA() : 1 - contact.shareOfA()),
      own_(facesOf(mesh, contact, onA)),
      other_(facesOf(mesh, contact, !onA)),
      ownSmooth_(smoothOf(mesh, onA ? contact.a : contact.b, own_)),
      otherSmooth_(smoothOf(mesh, onA ? contact.b : contact.a, other_)),
      ownFacets_(facetsOf(own_)),
      facets_(facetsOf(other_)),
      firstFacet_(own_.size() + 1, 0),
      search_(pointsOf(facets_)) {
  for (const Facet& facet : ownFacets_) ++firstFacet_[facet.side + 1];
  for (std::size_t side = 0; side < own_.size(); ++side) firstFacet_[side + 1] += firstFacet_[side];
}

int FaceSampling::functions(int side, bool whole) const {
  return whole ? own_[side].multipliers(contact_.multipliers) : own_[side].vertices();
}

bool FaceSampling::isFaceted() const {
  const auto isLinear = [](const std::vector<MortarFace>& faces) { return cellInfo(faces.front().cell()).order == 1; };
  const auto isCurved = [](const MortarFace& face) { return face.isCurved(); };
  return (isLinear(own_) || isLinear(other_)) &&
         (std::any_of(own_.begin(), own_.end(), isCurved) || std::any_of(other_.begin(), other_.end(), isCurved));
}

FaceSampling::Candidates FaceSampling::along(const std::vector<Point>& points, const Point& normal, int body) const {
  Candidates some;
  for (const int i : search_.along(points, normal)) {
    if (other_[facets_[i].side].body() == body) continue;
    const double across = dot(facets_[i].area, normal) / norm(facets_[i].area);
    if (across < -kAcross) some.facing.push_back(&facets_[i]);
    if (across > kEdgeOn) some.leaving.push_back(&facets_[i]);
  }
  return some;
}

/// True if the line from a facet behind a point to the point leaves the facet's body on the way: there is no interference, the bodies lie
/// next to each other, and the facet is on the far side of its body. \param place, from  the point, over the plane of the projection
bool FaceSampling::isThrough(const Facet& facet, const PlanePoint& place, double from, const Projection& projection,
                             const std::vector<const Facet*>& leaving) const {
  const auto wayTo = [&](const Facet& to) { return projection.wayTo(to.points[0], to.area, place) - from; };
  const double gap = wayTo(facet);
  if (gap >= 0.0) return false;
  const int body = other_[facet.side].body();
  return std::any_of(leaving.begin(), leaving.end(), [&](const Facet* other) {
    if (other_[other->side].body() != body) return false;
    const double way = wayTo(*other);
    if (way >= kWithin * gap || way <= (1 - kWithin) * gap) return false;
    const Polygon polygon = projection(other->points);
    const auto parts = convexParts(polygon);
    return std::any_of(parts.begin(), parts.end(),
                       [&](const auto& corners) { return contains(part(polygon, corners), place, tolerance(*other)); });
  });
}

double FaceSampling::tolerance(const Facet& facet) const {
  double size = 0;
  for (const Point& point : facet.points) size = std::max(size, norm(minus(point, facet.points[0])));
  return kSnap * size + kRound * norm(facet.points[0]);
}

Point FaceSampling::rowNormal(int side, int node) const {
  const MortarFace& own = own_[side];
  const Point &normal = own.normal(node), from = own.points()[node];
  const Projection projection(normal, from);
  auto facing = facingAt(from, projection, {from}, own.body(), 0.0);
  if (!facing) {
    const double away = (1 - MortarSamples::kReach) * own.size();
    const Point right = scaled(away, projection.first), up = scaled(away, projection.second);
    facing = facingAt(from, projection, {plus(from, right), minus(from, right), plus(from, up), minus(from, up)}, own.body(), away);
  }
  if (!facing) return normal;
  const auto rim = rim_.find(surface_.nodesOf(side)[node]);
  return rowNormalOf(normal, *facing, rim == rim_.end() ? nullptr : &rim->second);
}

/// Normal of the nearest opposite facet at the origin of a projection. \param from  the origin \param around  points of the search
/// \param beyond  distance from an edge up to which a facet extends [length]
std::optional<Point> FaceSampling::facingAt(const Point& from, const Projection& projection, const std::vector<Point>& around, int body,
                                            double beyond) const {
  const MortarFace* nearest = nullptr;
  ReferencePoint at{0, 0, 0};
  double least = 0;
  const Candidates candidates = along(around, projection.along, body);
  for (const Facet* facet : candidates.facing) {
    Polygon polygon = projection(facet->points);
    std::reverse(polygon.begin(), polygon.end());
    const auto parts = convexParts(polygon);
    const double within = std::max(beyond, kBeyond / kSnap * tolerance(*facet));
    if (std::none_of(parts.begin(), parts.end(), [&](const auto& corners) { return contains(part(polygon, corners), {0, 0}, within); }))
      continue;
    const auto place = ProjectedFace(other_[facet->side], facet->nodes, projection).meet({0, 0});
    if (!place) continue;
    const double gap = std::abs(dot(minus(place->point, from), projection.along));
    if (gap > contact_.reach || (nearest && gap >= least) || isThrough(*facet, {0, 0}, 0.0, projection, candidates.leaving)) continue;
    nearest = &other_[facet->side];
    at = place->at;
    least = gap;
  }
  if (!nearest) return std::nullopt;
  return nearest->normalAt(at);
}

/// Adds the intersections of a facet with the opposite facets.
FaceSampling::Areas FaceSampling::cut(const Facet& own, const Projection& projection, std::vector<Overlap>& overlaps) const {
  const Candidates candidates = along(own.points, projection.along, own_[own.side].body());
  const Polygon whole = projection(own.points);
  Areas areas{std::abs(areaOf(whole)), 0.0};
  for (const std::vector<int>& ownCorners : convexParts(whole)) {
    const Polygon convex = part(whole, ownCorners);
    if (areaOf(convex) <= 0) continue;  // seen from behind
    for (const Facet* other : candidates.facing) {
      Polygon polygon = projection(other->points);
      std::reverse(polygon.begin(), polygon.end());
      for (const std::vector<int>& corners : convexParts(polygon)) {
        Polygon common = commonPart(part(polygon, corners), convex, tolerance(own));
        if (common.empty()) continue;
        const PlanePoint middle = middleOf(common);
        if (isThrough(*other, middle, projection.wayTo(own.points[0], own.area, middle), projection, candidates.leaving)) continue;
        areas.common += areaOf(common);
        overlaps.push_back({&own, other, std::move(common)});
      }
    }
  }
  return areas;
}

std::optional<double> FaceSampling::covered(int side, const Point& normal) const {
  const Projection projection(normal, own_[side].points()[0]);
  std::vector<Overlap> overlaps;
  double whole = 0, common = 0;
  for (int i = firstFacet_[side]; i < firstFacet_[side + 1]; ++i) {
    const Areas areas = cut(ownFacets_[i], projection, overlaps);
    whole += areas.whole;
    common += std::min(areas.whole, areas.common);
  }
  return whole > 0 ? common / whole : 0.0;
}

MortarSamples FaceSampling::sample(int side, const Point& normal) const {
  const Projection projection(normal, own_[side].points()[0]);
  MortarSamples samples;
  double whole = 0, common = 0;
  for (int i = firstFacet_[side]; i < firstFacet_[side + 1]; ++i) {
    std::vector<Overlap> overlaps;
    const Areas areas = cut(ownFacets_[i], projection, overlaps);
    // Where facets of the other face lie behind each other, the nearest counts.
    std::vector<const Facet*> rivals;
    if (areas.common > (1 + kLayered) * areas.whole)
      for (const Overlap& overlap : overlaps) rivals.push_back(overlap.other);
    for (const Overlap& overlap : overlaps) {
      addSamples(overlap, projection, rivals, samples);
      if (areas.common < areas.whole) addReach(overlap, projection, samples.reach);
    }
    if (areas.common >= areas.whole)
      for (const int node : ownFacets_[i].nodes) samples.reach[node] = 1.0;
    whole += areas.whole;
    common += std::min(areas.whole, areas.common);
  }
  samples.covered = whole > 0 ? common / whole : 0.0;
  return samples;
}

void FaceSampling::addReach(const Overlap& overlap, const Projection& projection, ShapeValues& reach) const {
  const MortarFace& own = own_[overlap.own->side];
  const ProjectedFace shadow(own, overlap.own->nodes, projection);
  for (const PlanePoint& corner : overlap.polygon)
    if (const auto at = shadow.meet(corner)) {
      const ShapeValues linear = sideValues(own.vertices(), 3, at->at);
      for (int vertex = 0; vertex < own.vertices(); ++vertex) reach[vertex] = std::max(reach[vertex], linear[vertex]);
    }
}

/// True if no other facet is closer at a point.
bool FaceSampling::isNearest(const Facet& facet, double gap, const Point& from, const Projection& projection,
                             const std::vector<const Facet*>& rivals) const {
  const PlanePoint place = projection(from);
  for (const Facet* rival : rivals) {
    if (rival == &facet || rival->side == facet.side) continue;
    Polygon polygon = projection(rival->points);
    std::reverse(polygon.begin(), polygon.end());
    if (!contains(polygon, place, 0.0)) continue;
    const auto at = ProjectedFace(other_[rival->side], rival->nodes, projection).meet(place);
    if (at && std::abs(dot(minus(at->point, from), projection.along)) < std::abs(gap)) return false;
  }
  return true;
}

// Straight elements stay straight. They approximate the shape of the faces in contact, which is one surface with the curvature (1 - share)
// x own - share x other, seen from the carrying side.
void FaceSampling::addBulge(const MortarFace::Place& on, const SmoothFace& own, const MortarFace::Place& onOther, const SmoothFace& other,
                            const Point& normal, MortarSample& to) const {
  double mine = own.spread(on.values), its = other.spread(onOther.values);
  if (contact_.geometry != Contact::Geometry::Smooth) {
    const double itsOfMine = other.isLinear() && own.isCurved() ? other.spread(onOther.values, own.curvature(on.at)) : 0.0;
    if (own.isLinear()) mine = (1 - share_) * mine - (other.isCurved() ? share_ * own.spread(on.values, other.curvature(onOther.at)) : 0.0);
    if (other.isLinear()) its = share_ * its - (1 - share_) * itsOfMine;
  }
  const double way = own.way(on, mine, normal) + other.way(onOther, its, scaled(-1, normal));
  if (contact_.geometry == Contact::Geometry::Facets)
    to.doubt = way;
  else
    to.gap -= way, to.doubt = own.doubt(on.values) + other.doubt(onOther.values);
}

void FaceSampling::addSamples(const Overlap& overlap, const Projection& projection, const std::vector<const Facet*>& rivals,
                              MortarSamples& to) const {
  const MortarFace &own = own_[overlap.own->side], &other = other_[overlap.other->side];
  const SmoothFace &ownSmooth = ownSmooth_[overlap.own->side], &otherSmooth = otherSmooth_[overlap.other->side];
  const TriangleRule& rule = triangleRule(degreeOf(own, other, contact_.multipliers));
  const ProjectedFace ownShadow(own, overlap.own->nodes, projection), otherShadow(other, overlap.other->nodes, projection);
  const Polygon& polygon = overlap.polygon;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Polygon triangle{polygon[0], polygon[i], polygon[i + 1]};
    const double area = areaOf(triangle);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      PlanePoint place{0, 0};
      for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 2; ++c) place[c] += rule.points[q][k] * triangle[k][c];
      const auto on = ownShadow.meet(place), onOther = otherShadow.meet(place);
      if (!on || !onOther) continue;  // beyond the edge of a curved side: negligible weight
      MortarSample sample;
      sample.at = on->at, sample.own = on->values;
      sample.other = overlap.other->side, sample.others = onOther->values;
      // A surface inclined to the plane has a larger area than its projection.
      sample.weight = area * rule.weights[q] * std::sqrt(dot(on->density, on->density)) / dot(on->density, projection.along);
      sample.gap = dot(minus(onOther->point, on->point), projection.along);
      if (std::abs(sample.gap) > contact_.reach) continue;
      if (!rivals.empty() && !isNearest(*overlap.other, sample.gap, on->point, projection, rivals)) continue;
      if (contact_.initialGap)
        sample.gap = contact_.initialGap->at(on->point);
      else if (ownSmooth.hasBulge() || otherSmooth.hasBulge())
        addBulge(*on, ownSmooth, *onOther, otherSmooth, projection.along, sample);
      to.all.push_back(sample);
    }
  }
}

}  // namespace suture
