#pragma once
#include <suture/base/Types.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

#include <cmath>

namespace suture {

/// The map from the reference interval to a side of an element, at the points of a rule: the counterpart of ElementMap. Two-dimensional.
class SideMap {
 public:
  /// \param nodes  coordinates of the side's nodes, end points first; outlives the map
  /// \param axisymmetric  the side is revolved: weights have the factor 2 pi r
  SideMap(const std::vector<Point>& nodes, Rule rule, bool axisymmetric = false)
      : nodes_(nodes), reference_(referenceSide(static_cast<int>(nodes.size()), rule)), axisymmetric_(axisymmetric) {}

  const ReferenceElement& reference() const { return reference_; }

  /// Moves to a quadrature point.
  void at(int point) {
    place_ = tangent_ = {0, 0, 0};
    for (int a = 0; a < reference_.nodes; ++a)
      for (int k = 0; k < 2; ++k) {
        place_[k] += reference_.valuesAt(point)[a] * nodes_[a][k];
        tangent_[k] += reference_.weights[point] * reference_.gradientsAt(point)[a] * nodes_[a][k];
      }
    if (axisymmetric_)
      for (double& t : tangent_) t *= circumference(place_[0]);
  }

  const Point& place() const { return place_; }
  /// Weight of the point times the derivative of the place: of the length measure() [length]; axisymmetric: [area].
  const Point& tangent() const { return tangent_; }
  double measure() const { return std::hypot(tangent_[0], tangent_[1]); }

 private:
  const std::vector<Point>& nodes_;
  const ReferenceElement& reference_;
  bool axisymmetric_;
  Point place_{0, 0, 0}, tangent_{0, 0, 0};
};

}  // namespace suture
