#pragma once
#include <suture/mesh/Surface.hpp>

#include <vector>

namespace suture {

/// Curvature of the smooth curve on which the end points of straight sides of the drawn bodies lie. 2D; positive where the body is convex.
///
/// The curvature at a node between the chords u and v is that of the circle through the node and its two neighbours, 2 (u x v) / (|u| |v|
/// |u + v|): exact for arcs, exactly zero on straight lines. Along a side it is linear between the ends where the curvature varies
/// smoothly; otherwise, as at the joint of a line and an arc, it is constant and taken from the end whose outer neighbour agrees better
/// (ENO). The ends of a line and its corners (more than 45 degrees) take the value of the neighbouring node on the same side.
class BoundaryCurve {
 public:
  /// \throws InternalError  if the surface is not 2D
  explicit BoundaryCurve(const Surface& surface);

  /// Curvature along one side [1 / length].
  struct Bend {
    double begin = 0.0, end = 0.0;  ///< at its end points
    double doubt = 0.0;             ///< estimated error: difference from the next lower order of approximation, signed
    double at(double xi) const { return ((1 - xi) * begin + (1 + xi) * end) / 2; }
  };
  /// Curvature of a side of the surface.
  const Bend& bend(int side) const { return bends_[side]; }

 private:
  std::vector<Bend> bends_;
};

/// Height and slope of an arc over its chord.
struct Bulge {
  double height = 0.0, slope = 0.0;
};

/// Arc with a given curvature [1 / length] through the ends of a chord of length h, at xi in [-1, 1]; at most a half circle. Local.
Bulge arcOver(double curvature, double h, double xi);

}  // namespace suture
