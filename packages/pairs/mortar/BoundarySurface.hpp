#pragma once
#include <suture/mesh/Surface.hpp>

#include <array>
#include <vector>

namespace suture {

/// Normals and curvatures of the smooth surface on which the nodes of straight triangles and quadrilaterals lie. 3D counterpart of
/// BoundaryCurve.
///
/// At each node, a height over the tangent plane is fitted to the nodes of the surrounding sides (two rings where one has fewer than six)
/// by least squares with weights 1 / d^2: n.d + k (n.d)^2 / 2 = a.d - d.H d / 2, k = tr H^2 / tr H. The normal n is tilted by a until a
/// vanishes: exact on spheres, cylinders and planes. Each face of the geometry (SmoothParts) is fitted separately. Local.
class BoundarySurface {
 public:
  /// \param groupOf  group of each side; faces of the geometry end between groups. Empty: a single group
  /// \throws InternalError  if the surface is not 3D or its sides are not straight
  explicit BoundarySurface(const Surface& surface, const std::vector<int>& groupOf = {});

  /// The smooth surface at a node, for one of the adjacent sides.
  struct Jet {
    Point normal{0, 0, 0};                     ///< unit, outward
    std::array<Point, 3> bend{};               ///< rows of the curvature tensor H; > 0 where the body is convex [1 / length]
    double along = 0.0;                        ///< k, the coefficient of the squared height [1 / length]
    double curvature(const Point& arm) const;  ///< arm.H arm + k (n.arm)^2 [length]
  };
  /// Jets at the nodes of a side; empty for flat sides.
  const std::vector<Jet>& jets(int side) const { return jets_[side]; }

 private:
  std::vector<std::vector<Jet>> jets_;
};

}  // namespace suture
