#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/mortar/Clipping.hpp>
#include <suture/pairs/mortar/ShapeValues.hpp>

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace suture {

/// Projection along a direction onto the plane through a point that is normal to this direction.
class Projection {
 public:
  /// \param along  a unit vector
  Projection(const Point& along, const Point& origin);
  /// Position in this plane, seen against the direction: counter-clockwise orientation about the direction is preserved.
  PlanePoint operator()(const Point& point) const;
  Polygon operator()(const std::vector<Point>& points) const;
  /// Distance along the direction from a point of the plane to a flat surface. \param area  area vector of the surface, along its normal
  double wayTo(const Point& on, const Point& area, const PlanePoint& place) const;
  Point along, first, second;  ///< right-handed and orthonormal

 private:
  Point origin_;
};

/// An element of one face of a 3D contact, as a surface over its reference cell.
class MortarFace {
 public:
  /// \param body  body of the element, where needed
  /// \param drawn  see drawnNormals(); null: the surface is as drawn
  MortarFace(const Surface& surface, int side, int body = -1, const std::map<int, Point>* drawn = nullptr);
  /// Normals of a surface on the drawn bodies, by node.
  static std::map<int, Point> drawnNormals(const Surface& surface);

  Cell cell() const { return cell_; }
  int body() const { return body_; }
  int vertices() const { return cellInfo(cell_).vertices; }
  /// Number of multiplier functions where the other face covers the whole element.
  int multipliers(Contact::Multipliers choice) const {
    return choice == Contact::Multipliers::Quadratic ? static_cast<int>(points_.size()) : vertices();
  }
  const std::vector<Point>& points() const { return points_; }
  /// Largest distance of its nodes from the first one.
  double size() const { return size_; }
  /// Outward normal of the face at a node of the element, averaged over the adjacent sides.
  const Point& normal(int node) const { return normals_[node]; }
  /// Outward normal at a point of the element, interpolated between its nodes.
  Point normalAt(const ReferencePoint& at) const;

  /// Flat facets between its nodes that represent it where elements are intersected: the element itself if its edges are straight, else the
  /// linear parts between all of its nodes. By local numbers.
  const std::vector<std::vector<int>>& facets() const { return facets_; }
  /// True if the normals of the drawn face at the nodes of the element differ.
  bool isCurved() const { return curved_; }
  /// True if its edges are straight and mid-side nodes are in the middle.
  bool isStraight() const { return straight_; }
  /// Distance of a straight quadrilateral from a parallelogram, relative to its size; zero for triangles.
  double distortion() const { return distortion_; }

  /// Points in the reference cell with weights, exact for polynomials of degree ten.
  std::vector<std::pair<ReferencePoint, double>> quadrature() const;

  /// A point of the element.
  struct Place {
    ReferencePoint at{0, 0, 0};
    ShapeValues values{};  ///< shape functions
    Point point{0, 0, 0};
    Point density{0, 0, 0};  ///< area of the element per area of the reference cell, along the outward normal
  };
  Place place(const ReferencePoint& at) const;

 private:
  Cell cell_;
  int body_;
  std::vector<Point> points_, normals_;
  std::vector<std::vector<int>> facets_;
  bool straight_ = true, curved_ = false;
  double distortion_ = 0.0, size_ = 0.0;
};

/// An element in the plane of a projection.
class ProjectedFace {
 public:
  /// \param facet  the facet of the element on or near which points are sought
  ProjectedFace(const MortarFace& face, const std::vector<int>& facet, const Projection& projection);

  /// Point of the element, or of its continuation beyond its edges, that is projected onto a point of the plane. Newton's method, starting
  /// from the point on the flat facet; nothing if it does not converge.
  std::optional<MortarFace::Place> meet(const PlanePoint& point) const;

 private:
  const MortarFace& face_;
  std::array<PlanePoint, 9> nodes_;
  PlanePoint origin_;            // first corner of the facet
  ReferencePoint start_;         // reference coordinates of this corner
  std::array<double, 4> slope_;  // slopes of the reference coordinates over the flat facet, row by row
};

}  // namespace suture
