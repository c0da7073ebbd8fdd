#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairing/ContactSurface.hpp>
#include <suture/pairing/mortar/Clipping.hpp>
#include <suture/pairing/mortar/ShapeValues.hpp>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace suture {

/// The projection along a direction onto the plane across it through a point.
class Projection {
 public:
  /// \param along  a unit vector
  Projection(const Point& along, const Point& origin);
  /// Place in the plane, seen against the direction: what runs counter-clockwise about it does so in the plane.
  PlanePoint operator()(const Point& point) const;
  Polygon operator()(const std::vector<Point>& points) const;
  /// Way from a place in the plane along the direction to a flat surface. \param area  along its normal
  double wayTo(const Point& on, const Point& area, const PlanePoint& place) const;
  Point along, first, second;  ///< right-handed and orthonormal

 private:
  Point origin_;
};

/// An element of one face of a contact in space, as a surface over its reference cell.
class MortarFace {
 public:
  /// \param body  to which it belongs, where that matters
  MortarFace(const Surface& surface, int side, int body = -1);

  Cell cell() const { return cell_; }
  int body() const { return body_; }
  int vertices() const { return cellInfo(cell_).vertices; }
  /// Number of the multiplier's functions where the other face covers all of it.
  int multipliers(Contact::Multipliers choice) const {
    return choice == Contact::Multipliers::Quadratic ? static_cast<int>(points_.size()) : vertices();
  }
  const std::vector<Point>& points() const { return points_; }
  /// Outward normal of the face at a node of the element, averaged over its sides.
  const Point& normal(int node) const { return normals_[node]; }
  /// The same at a place on the element, interpolated between its nodes.
  Point normalAt(const ReferencePoint& at) const;

  /// Flat facets between its nodes that stand for it where elements are cut by each other: itself where its edges are straight, else the
  /// linear parts between all of its nodes. By local numbers.
  const std::vector<std::vector<int>>& facets() const { return facets_; }
  /// True if the normals of the face at its nodes differ.
  bool isCurved() const { return curved_; }
  /// True if its edges are straight, and a middle node is in the middle.
  bool isStraight() const { return straight_; }
  /// Distance of a straight quadrilateral from a parallelogram, relative to its size; zero of triangles.
  double distortion() const { return distortion_; }

  /// Points in the reference cell with weights, exact for polynomials of degree ten.
  std::vector<std::pair<ReferencePoint, double>> quadrature() const;

  /// A place on the element.
  struct Place {
    ReferencePoint at{0, 0, 0};
    ShapeValues values{};  ///< shape functions
    Point point{0, 0, 0};
    Point density{0, 0, 0};  ///< area of the element divided by that of the reference cell, along the outward normal
  };
  Place place(const ReferencePoint& at) const;

 private:
  Cell cell_;
  int body_;
  std::vector<Point> points_, normals_;
  std::vector<std::vector<int>> facets_;
  bool straight_ = true, curved_ = false;
  double distortion_ = 0.0;
};

/// An element in the plane of a projection.
class ProjectedFace {
 public:
  /// \param facet  one of the element's facets, on or beside which points are looked for
  ProjectedFace(const MortarFace& face, const std::vector<int>& facet, const Projection& projection);

  /// Place on the element, or its continuation beyond its edges, that is projected onto a point of the plane. By Newton's method, from the
  /// place on the flat facet; nothing if this does not end.
  std::optional<MortarFace::Place> meet(const PlanePoint& point) const;

 private:
  const MortarFace& face_;
  std::array<PlanePoint, 9> nodes_;
  PlanePoint origin_;            // first corner of the facet
  ReferencePoint start_;         // its place in the reference cell
  std::array<double, 4> slope_;  // of the place in the reference cell over the flat facet, row by row
};

}  // namespace suture
