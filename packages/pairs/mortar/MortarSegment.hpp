#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/mortar/BoundaryCurve.hpp>

#include <array>
#include <optional>
#include <vector>

namespace suture {

/// An element of one face of a contact as a curve on [-1, 1], with the body on its left.
class MortarSegment {
 public:
  MortarSegment(const Surface& surface, int side, const BoundaryCurve::Bend& bend, int body);

  const std::vector<int>& nodes() const { return nodes_; }
  const std::vector<Point>& points() const { return points_; }
  int body() const { return body_; }
  int count() const { return static_cast<int>(nodes_.size()); }
  const Point& end(int which) const { return points_[which]; }
  // Fast path for the ends: for most elements of the other side only they are needed.
  Point at(double xi) const { return xi == -1 ? points_[0] : xi == 1 ? points_[1] : mixed(xi); }
  Point tangent(double xi) const;  ///< its length is ds / d xi
  const Point& point(int node) const { return points_[node]; }
  /// Outward normal of the line at a node of the element.
  const Point& normal(int node) const { return normals_[node]; }
  /// Outward normal at a point, interpolated between the nodes.
  Point normalAt(double xi) const;
  double length() const { return norm(minus(points_[1], points_[0])); }

  /// Curvature of the line at a point. [1 / length]
  double curvature(double xi) const { return bend_.at(xi); }
  double curvatureDoubt() const { return bend_.doubt; }
  bool isCurved() const { return bend_.begin != 0 || bend_.end != 0; }
  bool isLinear() const { return count() == 2; }
  /// True if its points lie on its chord. A mid-side node on the curve gives the element its true shape.
  bool isStraight() const { return straight_; }
  /// Curvature of the parabola through three nodes. [1 / length]
  double ownCurvature() const { return 8 * height_ / (length() * length()); }
  /// \param change  change of the line's curvature from the beginning of the element to its end [1 / length]
  void setChange(double change) { change_ = change; }
  /// Estimated distance of the line from a curved element at a point, as far as displacements do not compensate it: a bound on the error of
  /// a parabola for an arc, plus part of its error for a curvature that changes along the element. [length]
  double awayFromCurve(double xi) const;
  /// Distance along `direction`, a unit vector out of the body, from a point of a straight element to the arc of this curvature over it.
  double wayToArc(double curvature, double xi, const Point& direction) const;

 private:
  Point mixed(double xi) const;
  std::vector<int> nodes_;
  int body_;
  std::vector<Point> points_, normals_;
  BoundaryCurve::Bend bend_;
  bool straight_ = true;
  double height_ = 0.0;  // outward distance of the middle node from the chord
  double skew_ = 0.0;    // tangential distance of the mid-side node from the middle of the chord
  double change_ = 0.0;  // change of the curvature from begin to end [1 / length]
};

}  // namespace suture
