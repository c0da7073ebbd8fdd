#pragma once
#include <suture/mesh/Surface.hpp>

#include <array>
#include <vector>

namespace suture {

/// Normals and curvatures of the smooth surface on which the nodes of straight sides, triangles and quadrilaterals, lie. In space; the
/// counterpart of BoundaryCurve.
///
/// At a node a height over the tangent plane is fitted to the nodes of the sides around it, of two rings where these are fewer than six, by
/// least squares with weights 1 / d^2: n.d + k (n.d)^2 / 2 = a.d - d.H d / 2, k = tr H^2 / tr H, and the normal n is tilted by a until a
/// vanishes: exact on spheres, cylinders and planes. Each face of the geometry (SmoothParts) is fitted by itself. Local.
class BoundarySurface {
 public:
  /// \param groupOf  group of each side; faces of the geometry end between groups. Empty: one for all
  /// \throws InternalError  the surface is not in space, or its sides are not straight
  explicit BoundarySurface(const Surface& surface, const std::vector<int>& groupOf = {});

  /// The smooth surface at a node, as one of its sides has it.
  struct Jet {
    Point normal{0, 0, 0};                     ///< unit, outward
    std::array<Point, 3> bend{};               ///< rows of the curvature tensor H; > 0 where the body is convex [1 / length]
    double along = 0.0;                        ///< k, the coefficient of the squared height [1 / length]
    double curvature(const Point& arm) const;  ///< arm.H arm + k (n.arm)^2 [length]
  };
  /// Jets at the nodes of a side; empty of flat ones.
  const std::vector<Jet>& jets(int side) const { return jets_[side]; }

 private:
  std::vector<std::vector<Jet>> jets_;
};

}  // namespace suture
