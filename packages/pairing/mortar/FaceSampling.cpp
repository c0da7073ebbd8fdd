#include <suture/pairing/mortar/FaceSampling.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kAcross = 0.5;         // cosine of the angle up to which two normals are opposite
constexpr double kAntiparallel = 1e-9;  // sine of the angle up to which two sides are parallel
constexpr double kSnap = 1e-12;         // distance of a corner from an edge on which it lies, relative to the facet
constexpr double kRound = 1e-15;        // the same relative to the coordinates
constexpr double kBeyond = 1e-9;        // distance beyond an edge at which a node still stands opposite to a facet, relative to the facet
constexpr double kLayered = 1e-9;       // area of common parts beyond that of the facet, relative to it
constexpr int kCurvedDegree = 5, kMostDegree = 10;  // of quadratures: over parts of curved faces, of distorted sides
constexpr double kDistorted = 1e-9;                 // terms of integrands left out

std::vector<MortarFace> facesOf(const Mesh& mesh, const Surface& surface) {
  std::vector<MortarFace> all;
  for (int side = 0; side < surface.sides(); ++side) all.emplace_back(surface, side, mesh.bodyOfNode[surface.nodesOf(side)[0]]);
  return all;
}

/// Integrals of the functions of all nodes. [area]
std::map<int, double> nodeHats(const Surface& surface, const std::vector<MortarFace>& faces) {
  std::map<int, double> hats;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int>& nodes = surface.nodesOf(side);
    for (const auto& [at, weight] : faces[side].quadrature()) {
      const ShapeValues values = multiplierValues(static_cast<int>(nodes.size()), 3, at);
      const double area = weight * norm(faces[side].density(at));
      for (std::size_t k = 0; k < nodes.size(); ++k) hats[nodes[k]] += area * values[k];
    }
  }
  return hats;
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

/// Degree of the quadrature over the common part of two sides: that of shape functions times multiplier, where they are polynomials of the
/// place in space. Of distorted quadrilaterals they are series whose terms of a higher degree have the distortion's powers as factors. Over
/// curved faces the shape of the elements is the larger error.
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
      Facet facet{static_cast<int>(side), {}, {0, 0, 0}, {0, 0, 0}};
      for (const int node : nodes) {
        facet.points.push_back(sides[side].points()[node]);
        facet.middle = plus(facet.middle, scaled(1.0 / double(nodes.size()), referencePoint(sides[side].cell(), node)));
      }
      const std::vector<Point>& p = facet.points;
      facet.area = scaled(0.5, p.size() == 3 ? cross(minus(p[1], p[0]), minus(p[2], p[0])) : cross(minus(p[2], p[0]), minus(p[3], p[1])));
      all.push_back(std::move(facet));
    }
  return all;
}

FaceSampling::FaceSampling(const Mesh& mesh, const ContactSurface& contact, bool onA)
    : contact_(contact),
      own_(facesOf(mesh, *(onA ? contact.a : contact.b).surface)),
      other_(facesOf(mesh, *(onA ? contact.b : contact.a).surface)),
      ownFacets_(facetsOf(own_)),
      facets_(facetsOf(other_)),
      firstFacet_(own_.size() + 1, 0),
      search_(pointsOf(facets_)),
      hats_(contact.multipliers == Contact::Multipliers::Quadratic ? nodeHats(*(onA ? contact.a : contact.b).surface, own_)
                                                                   : vertexHats(*(onA ? contact.a : contact.b).surface)) {
  for (const Facet& facet : ownFacets_) ++firstFacet_[facet.side + 1];
  for (std::size_t side = 0; side < own_.size(); ++side) firstFacet_[side + 1] += firstFacet_[side];
}

int FaceSampling::functions(int side, bool whole) const {
  const bool all = whole && contact_.multipliers == Contact::Multipliers::Quadratic;
  return all ? static_cast<int>(own_[side].points().size()) : own_[side].vertices();
}

bool FaceSampling::isFaceted() const {
  const auto isLinear = [](const std::vector<MortarFace>& faces) { return cellInfo(faces.front().cell()).order == 1; };
  const auto isCurved = [](const MortarFace& face) { return face.isCurved(); };
  return (isLinear(own_) || isLinear(other_)) &&
         (std::any_of(own_.begin(), own_.end(), isCurved) || std::any_of(other_.begin(), other_.end(), isCurved));
}

/// Facets of other bodies that face a normal and may meet the lines along it through some points.
std::vector<const FaceSampling::Facet*> FaceSampling::opposite(const std::vector<Point>& points, const Point& normal, int body) const {
  std::vector<const Facet*> some;
  for (const int i : search_.along(points, normal))
    if (other_[facets_[i].side].body() != body && dot(facets_[i].area, normal) < -kAcross * norm(facets_[i].area))
      some.push_back(&facets_[i]);
  return some;
}

double FaceSampling::tolerance(const Facet& facet) const {
  double size = 0;
  for (const Point& point : facet.points) size = std::max(size, norm(minus(point, facet.points[0])));
  return kSnap * size + kRound * norm(facet.points[0]);
}

Point FaceSampling::meanNormal(int side, int node) const {
  const MortarFace& own = own_[side];
  const Point &normal = own.normal(node), from = own.points()[node];
  const Projection projection(normal, from);
  const MortarFace* nearest = nullptr;
  ReferencePoint at{0, 0, 0};
  double least = 0;
  for (const Facet* facet : opposite({from}, normal, own.body())) {
    Polygon polygon = projection(facet->points);
    std::reverse(polygon.begin(), polygon.end());
    const auto parts = convexParts(polygon);
    const double beyond = kBeyond / kSnap * tolerance(*facet);
    if (std::none_of(parts.begin(), parts.end(), [&](const auto& corners) { return contains(part(polygon, corners), {0, 0}, beyond); }))
      continue;
    const auto place = other_[facet->side].meet(from, projection, facet->middle);
    if (!place) continue;
    const double gap = std::abs(dot(minus(other_[facet->side].at(*place), from), normal));
    if (nearest && gap >= least) continue;
    nearest = &other_[facet->side];
    at = *place;
    least = gap;
  }
  if (!nearest) return normal;
  const Point facing = nearest->normalAt(at);
  return norm(cross(normal, facing)) > kAntiparallel ? unit(minus(normal, facing)) : normal;
}

/// Adds the common parts of a facet with those opposite. \return the area of its projection
double FaceSampling::cut(const Facet& own, const Projection& projection, std::vector<Overlap>& overlaps) const {
  const std::vector<const Facet*> candidates = opposite(own.points, projection.along, own_[own.side].body());
  const Polygon whole = projection(own.points);
  for (const std::vector<int>& ownCorners : convexParts(whole)) {
    const Polygon convex = part(whole, ownCorners);
    if (areaOf(convex) <= 0) continue;  // seen from behind
    for (const Facet* other : candidates) {
      Polygon polygon = projection(other->points);
      std::reverse(polygon.begin(), polygon.end());
      for (const std::vector<int>& corners : convexParts(polygon)) {
        Polygon common = commonPart(part(polygon, corners), convex, tolerance(own));
        if (!common.empty()) overlaps.push_back({&own, other, std::move(common)});
      }
    }
  }
  return std::abs(areaOf(whole));
}

MortarSamples FaceSampling::sample(int side, const Point& normal) const {
  const Projection projection(normal, own_[side].points()[0]);
  MortarSamples samples;
  double whole = 0, common = 0;
  for (int i = firstFacet_[side]; i < firstFacet_[side + 1]; ++i) {
    std::vector<Overlap> overlaps;
    const double area = cut(ownFacets_[i], projection, overlaps);
    double sum = 0;
    for (const Overlap& overlap : overlaps) sum += areaOf(overlap.polygon);
    // Where facets of the other face lie behind each other the nearest counts.
    std::vector<const Facet*> rivals;
    if (sum > (1 + kLayered) * area)
      for (const Overlap& overlap : overlaps) rivals.push_back(overlap.other);
    for (const Overlap& overlap : overlaps) addSamples(overlap, projection, rivals, samples);
    whole += area;
    common += std::min(sum, area);
  }
  samples.covered = whole > 0 ? common / whole : 0.0;
  return samples;
}

/// True if no other facet is nearer at a point.
bool FaceSampling::isNearest(const Facet& facet, double gap, const Point& from, const Projection& projection,
                             const std::vector<const Facet*>& rivals) const {
  const PlanePoint place = projection(from);
  for (const Facet* rival : rivals) {
    if (rival == &facet || rival->side == facet.side) continue;
    Polygon polygon = projection(rival->points);
    std::reverse(polygon.begin(), polygon.end());
    if (!contains(polygon, place, 0.0)) continue;
    const auto at = other_[rival->side].meet(from, projection, rival->middle);
    if (at && std::abs(dot(minus(other_[rival->side].at(*at), from), projection.along)) < std::abs(gap)) return false;
  }
  return true;
}

void FaceSampling::addSamples(const Overlap& overlap, const Projection& projection, const std::vector<const Facet*>& rivals,
                              MortarSamples& to) const {
  const MortarFace &own = own_[overlap.own->side], &other = other_[overlap.other->side];
  const TriangleRule& rule = triangleRule(degreeOf(own, other, contact_.multipliers));
  const Polygon& polygon = overlap.polygon;
  ReferencePoint start = overlap.own->middle, otherStart = overlap.other->middle;  // then the last point, which is near
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Polygon triangle{polygon[0], polygon[i], polygon[i + 1]};
    const double area = areaOf(triangle);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      PlanePoint place{0, 0};
      for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 2; ++c) place[c] += rule.points[q][k] * triangle[k][c];
      const Point through = projection.at(place);
      const auto at = own.meet(through, projection, start), otherAt = other.meet(through, projection, otherStart);
      if (!at || !otherAt) continue;  // beyond the edge of a curved side: of no weight
      start = *at, otherStart = *otherAt;
      const Point from = own.at(*at), outward = own.density(*at);
      MortarSample sample;
      sample.at = *at, sample.other = overlap.other->side, sample.otherAt = *otherAt;
      // A surface that leans against the plane has more area than its projection.
      sample.weight = area * rule.weights[q] * norm(outward) / dot(outward, projection.along);
      sample.gap = dot(minus(other.at(*otherAt), from), projection.along);
      if (!rivals.empty() && !isNearest(*overlap.other, sample.gap, from, projection, rivals)) continue;
      if (contact_.initialGap) sample.gap = contact_.initialGap->at(from);
      to.all.push_back(sample);
    }
  }
}

}  // namespace suture
