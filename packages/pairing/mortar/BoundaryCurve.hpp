#pragma once
#include <suture/mesh/Surface.hpp>

#include <vector>

namespace suture {

/// Curvature of the smooth line on which the end points of straight sides lie. Plane; signed: > 0 where the body is convex.
///
/// At a node between the chords u and v it is that of the circle through three neighbours, 2 (u x v) / (|u| |v| |u + v|): exact for arcs,
/// exactly zero on straight lines. Along a side it is linear between its ends where the curvature varies smoothly; else, as at the joint
/// of a line and an arc, constant from that end whose outer neighbour agrees better (ENO). The ends of a line and its corners (more than
/// 45 degrees) take the value of the neighbouring node on their side.
class BoundaryCurve {
 public:
  /// \throws InternalError  the surface is not in the plane
  explicit BoundaryCurve(const Surface& surface);

  /// Curvature along one side [1 / length].
  struct Bend {
    double begin = 0.0, end = 0.0;  ///< at its end points
    double doubt = 0.0;             ///< estimated error: difference to the next lower order of construction, with its sign
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

/// The arc of a curvature [1 / length] through the ends of a chord of the length h, at xi in [-1, 1]; of at most a half circle. Local.
Bulge arcOver(double curvature, double h, double xi);

}  // namespace suture
