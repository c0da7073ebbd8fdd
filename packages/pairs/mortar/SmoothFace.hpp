#pragma once
#include <suture/pairs/mortar/BoundarySurface.hpp>
#include <suture/pairs/mortar/MortarFace.hpp>

#include <vector>

namespace suture {

/// The smooth surface over one element of a contact face in 3D.
///
/// Over an element with the shape functions L_i, normals N_i of the surface at its nodes and d_ij = x_j - x_i, the spread
///     Q = sum over i < j of L_i L_j d_ij.(N_j - N_i)
/// is twice the height of the surface. With N and k the same means of the normals and of the jets' coefficients of the squared height, the
/// distance s to the surface along n solves k s^2 + 2 s n.N = Q: exact on spheres and, along the normal, on cylinders, for triangles and
/// quadrilaterals, flat or warped.
class SmoothFace {
 public:
  /// \param jets  of the surface at the nodes; empty for flat and second-order sides
  SmoothFace(const MortarFace& face, const std::vector<BoundarySurface::Jet>& jets);

  /// True if the surface differs from the element.
  bool hasBulge() const { return !jets_.empty(); }
  /// True if the surface or the element itself is curved.
  bool isCurved() const { return hasBulge() || face_.isCurved(); }
  bool isLinear() const { return face_.points().size() <= 4; }

  /// Curvature at a point: the change of the normal along a step.
  struct Curvature {
    Point s{0, 0, 0}, t{0, 0, 0}, normalS{0, 0, 0}, normalT{0, 0, 0};  ///< derivatives of position and normal in the reference cell
    double ss = 0.0, st = 0.0, tt = 0.0;                               ///< inverse of the metric
    double along(const Point& arm) const;                              ///< arm.(change of the normal along it) [length]
  };
  Curvature curvature(const ReferencePoint& at) const;

  /// Spread Q of the surface at a point. [length]
  double spread(const ShapeValues& values) const;
  /// Spread of a given curvature over this element. [length]
  double spread(const ShapeValues& values, const Curvature& curvature) const;
  /// Estimated error of the height: difference from the height by the curvatures of the jets, an approximation of lower order. [length]
  double doubt(const ShapeValues& values) const;
  /// Distance from the element to the surface with a given spread, along a direction out of the body. [length]
  double way(const MortarFace::Place& place, double spread, const Point& direction) const;

 private:
  template <typename Function>
  double sumOverPairs(const ShapeValues& values, const Function& of) const;
  const MortarFace& face_;
  std::vector<BoundarySurface::Jet> jets_;
};

}  // namespace suture
