#pragma once
#include <suture/base/Point.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

namespace suture {

/// Map from the reference side (2D: interval, 3D: triangle or square) to a side of an element, at the points of a quadrature rule: the
/// counterpart of ElementMap.
class SideMap {
 public:
  /// \param nodes  coordinates of the side's nodes, in the order of SideGeometry.hpp; must outlive the map
  /// \param axisymmetric  the side is revolved: weights have the factor 2 pi r
  SideMap(const std::vector<Point>& nodes, int dimension, Rule rule, bool axisymmetric = false)
      : nodes_(nodes), reference_(referenceSide(static_cast<int>(nodes.size()), dimension, rule)), axisymmetric_(axisymmetric) {}

  const ReferenceElement& reference() const { return reference_; }

  /// Moves to a quadrature point.
  void at(int point) {
    place_ = {0, 0, 0};
    Point tangents[2] = {{0, 0, 0}, {0, 0, 0}};
    const int directions = reference_.dimension;
    const double *values = reference_.valuesAt(point), *gradients = reference_.gradientsAt(point), weight = reference_.weights[point];
    for (int a = 0; a < reference_.nodes; ++a)
      for (int k = 0; k <= directions; ++k) {
        place_[k] += values[a] * nodes_[a][k];
        tangents[0][k] += weight * gradients[directions * a] * nodes_[a][k];
        if (directions == 2) tangents[1][k] += gradients[2 * a + 1] * nodes_[a][k];
      }
    // In 2D the body is on the left when moving along the side.
    normal_ = directions == 1 ? Point{tangents[0][1], -tangents[0][0], 0} : cross(tangents[0], tangents[1]);
    if (axisymmetric_)
      for (double& n : normal_) n *= circumference(place_[0]);
  }

  const Point& place() const { return place_; }
  /// Outward normal, times the weight of the point, times the size ratio of the side to the reference side; a polynomial also on curved
  /// sides. [length; area in 3D and for revolved sides]
  const Point& normal() const { return normal_; }
  /// Length of normal(): the size of the side that belongs to the point.
  double measure() const { return norm(normal_); }

 private:
  const std::vector<Point>& nodes_;
  const ReferenceElement& reference_;
  bool axisymmetric_;
  Point place_{0, 0, 0}, normal_{0, 0, 0};
};

}  // namespace suture
