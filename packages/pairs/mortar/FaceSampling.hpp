#pragma once
#include <suture/pairs/PairSearch.hpp>
#include <suture/pairs/mortar/MortarFace.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>
#include <suture/pairs/mortar/SmoothFace.hpp>

#include <map>
#include <vector>

namespace suture {

/// Two facing surfaces of a contact in 3D: quadrature points where the carrying surface meets the other along a given normal. The sides of
/// both are projected along this normal onto a plane and intersected; each common polygon is divided into triangles for quadrature, and the
/// points are mapped back onto both sides (Puso and Laursen 2004; Popp, Gitterle, Gee and Wall 2010, who use one normal per side, here one
/// per condition). Integrals over flat faces are exact for triangles and parallelograms and nearly so for distorted quadrilaterals. Curved
/// sides are cut along the straight lines between their nodes; gaps between second-order sides are measured between the sides themselves.
/// Between first-order sides whose nodes lie on smooth surfaces the gap is that of the surfaces (SmoothFace); Contact::Geometry has the
/// same meaning as between lines (LineSampling).
///
/// On second-order sides that are covered entirely the multiplier has one function per node, with positive integrals (multiplierValues).
/// The condition of a vertex then has one node of the carrying face, that of a mid-side node also the two adjacent vertices: the conditions
/// can be solved successively for the displacements of their nodes. Partly covered sides, and all sides with Contact::Multipliers Linear,
/// have one function per vertex. Local.
class FaceSampling : public MortarSampling {
 public:
  FaceSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  FaceSampling(const FaceSampling&) = delete;
  FaceSampling& operator=(const FaceSampling&) = delete;

  int functions(int side, bool whole) const override;
  Point rowNormal(int side, int node) const override;
  MortarSamples sample(int side, const Point& normal) const override;
  std::optional<double> covered(int side, const Point& normal) const override;
  bool isFaceted() const override;
  bool estimatesDoubt() const override { return isFaceted(); }

 private:
  /// Flat part of a side.
  struct Facet {
    int side;
    std::vector<Point> points;
    std::vector<int> nodes;  // local numbers
    Point area;              // along its normal [area]
  };
  /// Intersection of two facets in the plane of a projection.
  struct Overlap {
    const Facet *own, *other;
    Polygon polygon;
  };
  /// Adds the distance by which the smooth surfaces are closer than their elements. \param normal  out of the carrying side
  void addBulge(const MortarFace::Place& on, const SmoothFace& own, const MortarFace::Place& onOther, const SmoothFace& other,
                const Point& normal, MortarSample& to) const;
  static std::vector<Facet> facetsOf(const std::vector<MortarFace>& sides);
  /// Facets of other bodies that the lines may meet.
  struct Candidates {
    std::vector<const Facet*> facing, leaving;  ///< facets oriented against the direction of the lines, and along it
  };
  /// Candidates for the lines along a normal through some points.
  Candidates along(const std::vector<Point>& points, const Point& normal, int body) const;
  std::optional<Point> facingAt(const Point& from, const Projection& projection, const std::vector<Point>& around, int body,
                                double beyond) const;
  bool isThrough(const Facet& facet, const PlanePoint& place, double from, const Projection& projection,
                 const std::vector<const Facet*>& leaving) const;
  double tolerance(const Facet& facet) const;
  /// Areas of the projected facet and of its intersections with others.
  struct Areas {
    double whole = 0.0, common = 0.0;
  };
  Areas cut(const Facet& own, const Projection& projection, std::vector<Overlap>& overlaps) const;
  void addSamples(const Overlap& overlap, const Projection& projection, const std::vector<const Facet*>& rivals, MortarSamples& to) const;
  /// Adds the values of the linear vertex functions at the corners of an intersection.
  void addReach(const Overlap& overlap, const Projection& projection, ShapeValues& reach) const;
  bool isNearest(const Facet& facet, double gap, const Point& from, const Projection& projection,
                 const std::vector<const Facet*>& rivals) const;

  const ContactSurface& contact_;
  const Surface& surface_;
  std::map<int, Point> rim_;  // see rimOf()
  double share_;              // fraction of the change of curvature that the carrying side takes where both are pressed together
  std::vector<MortarFace> own_, other_;
  std::vector<SmoothFace> ownSmooth_, otherSmooth_;
  std::vector<Facet> ownFacets_, facets_;  // facets_: of the other face
  std::vector<int> firstFacet_;            // first facet of each side of the carrying face, then the total number
  PairSearch search_;
};

}  // namespace suture
