#pragma once
#include <suture/pairing/PairSearch.hpp>
#include <suture/pairing/mortar/MortarFace.hpp>
#include <suture/pairing/mortar/MortarSampling.hpp>
#include <suture/pairing/mortar/SmoothFace.hpp>

#include <vector>

namespace suture {

/// Two facing surfaces of a contact in space: points where the carrying surface meets the other along a given normal. The sides of both are
/// projected along it onto a plane and cut by each other; each common polygon is divided into triangles for quadrature, whose points are
/// mapped back onto both sides (Puso and Laursen 2004; Popp, Gitterle, Gee and Wall 2010, who project along one normal a side instead of
/// one a condition). Integrals over flat faces are exact where sides are triangles or parallelograms, and nearly so over distorted
/// quadrilaterals. Curved sides are cut along the straight lines between their nodes; gaps are those of the sides themselves, where these
/// are of second order. Between sides of first order whose nodes lie on smooth surfaces the gap is that of the surfaces (SmoothFace), with
/// the same meaning of Contact::Geometry as between lines (LineSampling).
///
/// On second-order sides that are covered wholly the multiplier has a function for each node, with positive integrals (multiplierValues).
/// The condition of a vertex then has one node of its own face, that of a middle node also the two vertices beside it: one after the other
/// they can be solved for the displacement of their node. Sides that are covered in part, and all with Contact::Multipliers Linear, have
/// one for each vertex. Local.
class FaceSampling : public MortarSampling {
 public:
  FaceSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  FaceSampling(const FaceSampling&) = delete;
  FaceSampling& operator=(const FaceSampling&) = delete;

  int functions(int side, bool whole) const override;
  Point meanNormal(int side, int node) const override;
  MortarSamples sample(int side, const Point& normal) const override;
  std::optional<double> covered(int side, const Point& normal) const override;
  bool isFaceted() const override;
  bool estimatesDoubt() const override { return isFaceted(); }

 private:
  /// A flat part of a side.
  struct Facet {
    int side;
    std::vector<Point> points;
    std::vector<int> nodes;  // local numbers
    Point area;              // along its normal [area]
  };
  /// The common part of two facets, in the plane of a projection.
  struct Overlap {
    const Facet *own, *other;
    Polygon polygon;
  };
  /// Adds what the smooth surfaces are nearer than their elements. \param normal  out of the carrying side
  void addBulge(const MortarFace::Place& on, const SmoothFace& own, const MortarFace::Place& onOther, const SmoothFace& other,
                const Point& normal, MortarSample& to) const;
  static std::vector<Facet> facetsOf(const std::vector<MortarFace>& sides);
  /// Facets of other bodies that lines may meet.
  struct Candidates {
    std::vector<const Facet*> facing, leaving;  ///< against the direction of the lines, and along it
  };
  /// Those that may meet the lines along a normal through some points.
  Candidates along(const std::vector<Point>& points, const Point& normal, int body) const;
  bool isThrough(const Facet& facet, const PlanePoint& place, double from, const Projection& projection,
                 const std::vector<const Facet*>& leaving) const;
  double tolerance(const Facet& facet) const;
  /// Areas of the projection of a facet, and of its common parts.
  struct Areas {
    double whole = 0.0, common = 0.0;
  };
  Areas cut(const Facet& own, const Projection& projection, std::vector<Overlap>& overlaps) const;
  void addSamples(const Overlap& overlap, const Projection& projection, const std::vector<const Facet*>& rivals, MortarSamples& to) const;
  /// Adds the values of the vertices' linear functions at the corners of a common part.
  void addReach(const Overlap& overlap, const Projection& projection, ShapeValues& reach) const;
  bool isNearest(const Facet& facet, double gap, const Point& from, const Projection& projection,
                 const std::vector<const Facet*>& rivals) const;

  const ContactSurface& contact_;
  double share_;  // share of the change of curvature that the carrying side takes where both are pressed together
  std::vector<MortarFace> own_, other_;
  std::vector<SmoothFace> ownSmooth_, otherSmooth_;
  std::vector<Facet> ownFacets_, facets_;  // facets_: of the other face
  std::vector<int> firstFacet_;            // first facet of each own side, and the number of all
  PairSearch search_;
};

}  // namespace suture
