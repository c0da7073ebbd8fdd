#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairing/mortar/Clipping.hpp>

#include <map>
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
  /// Point of the plane in space.
  Point at(const PlanePoint& place) const;

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
  const std::vector<Point>& points() const { return points_; }
  /// Outward normal of the face at a node of the element, averaged over its sides.
  const Point& normal(int node) const { return normals_[node]; }
  /// The same at a place on the element, interpolated between its nodes.
  Point normalAt(const ReferencePoint& at) const;
  Point at(const ReferencePoint& at) const;
  /// Cross product of the derivatives of the place by the two reference coordinates: along the outward normal of the element itself.
  Point density(const ReferencePoint& at) const;

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

  /// Place where the line of a projection through a point meets the element, or its continuation beyond its edges. By Newton's method;
  /// nothing if this does not end. \param start  where it begins
  std::optional<ReferencePoint> meet(const Point& point, const Projection& projection, const ReferencePoint& start) const;

 private:
  Cell cell_;
  int body_;
  std::vector<Point> points_, normals_;
  std::vector<std::vector<int>> facets_;
  bool straight_ = true, curved_ = false;
  double distortion_ = 0.0;
};

/// Integrals over a surface of the linear functions of its vertices, by node. Local. [area]
std::map<int, double> vertexHats(const Surface& surface);

}  // namespace suture
