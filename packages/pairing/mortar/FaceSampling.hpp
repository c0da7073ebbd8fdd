#pragma once
#include <suture/pairing/PairSearch.hpp>
#include <suture/pairing/mortar/MortarFace.hpp>
#include <suture/pairing/mortar/MortarSampling.hpp>

#include <map>
#include <vector>

namespace suture {

/// Two facing surfaces of a contact in space: points where the carrying surface meets the other along a given normal. The sides of both are
/// projected along it onto a plane and cut by each other; each common polygon is divided into triangles for quadrature, whose points are
/// mapped back onto both sides (Puso and Laursen 2004; Popp, Gitterle, Gee and Wall 2010, who project along one normal a side instead of
/// one a condition). Integrals over flat faces are exact where sides are triangles or parallelograms, and nearly so over distorted
/// quadrilaterals. Curved sides are cut along the straight lines between their nodes; gaps are those of the sides themselves.
///
/// The multiplier has a function for each vertex, of second-order sides, too: the integrals of their quadratic functions are zero or
/// negative at the vertices. With Contact::Multipliers Quadratic it has one for each node of a side that is covered wholly
/// (multiplierValues). Local.
class FaceSampling : public MortarSampling {
 public:
  FaceSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  FaceSampling(const FaceSampling&) = delete;
  FaceSampling& operator=(const FaceSampling&) = delete;

  int functions(int side, bool whole) const override;
  Point meanNormal(int side, int node) const override;
  MortarSamples sample(int side, const Point& normal) const override;
  double hat(int node) const override { return hats_.at(node); }
  bool isFaceted() const override;

 private:
  /// A flat part of a side.
  struct Facet {
    int side;
    std::vector<Point> points;
    Point area;             // along its normal [area]
    ReferencePoint middle;  // in the side's reference cell
  };
  /// The common part of two facets, in the plane of a projection.
  struct Overlap {
    const Facet *own, *other;
    Polygon polygon;
  };
  static std::vector<Facet> facetsOf(const std::vector<MortarFace>& sides);
  std::vector<const Facet*> opposite(const std::vector<Point>& points, const Point& normal, int body) const;
  double tolerance(const Facet& facet) const;
  double cut(const Facet& own, const Projection& projection, std::vector<Overlap>& overlaps) const;
  void addSamples(const Overlap& overlap, const Projection& projection, const std::vector<const Facet*>& rivals, MortarSamples& to) const;
  bool isNearest(const Facet& facet, double gap, const Point& from, const Projection& projection,
                 const std::vector<const Facet*>& rivals) const;

  const ContactSurface& contact_;
  std::vector<MortarFace> own_, other_;
  std::vector<Facet> ownFacets_, facets_;  // facets_: of the other face
  std::vector<int> firstFacet_;            // of each own side, and their number
  PairSearch search_;
  std::map<int, double> hats_;
};

}  // namespace suture
