#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairing/ContactSurface.hpp>
#include <suture/pairing/mortar/ShapeValues.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace suture {

/// A point of both faces of a contact, on a line along the normal of one of its conditions.
struct MortarSample {
  ReferencePoint at{0, 0, 0};   ///< place on the side of the carrying face
  double weight = 0.0;          ///< quadrature weight [length or area]; axisymmetric: times 2 pi r [area]
  double gap = 0.0;             ///< way to the other face along the normal [length]
  double doubt = 0.0;           ///< estimated error of the gap by the shape of the elements [length]
  int other = -1;               ///< side of the other face; -1: a rigid obstacle
  ShapeValues own{}, others{};  ///< shape functions of both sides there
};

/// Quadrature points of one side of the carrying face.
struct MortarSamples {
  std::vector<MortarSample> all;
  double covered = 0.0;  ///< part of the side that the other face stands opposite to
  /// Largest value of each vertex's linear function on this part: how near the other face comes to the vertex; 1 where it reaches it.
  ShapeValues reach{};

  bool isWhole() const { return covered > 1 - 1e-8; }
};

/// Points at which the conditions of a mortar compare the face that carries them with the other, in the plane and in space. One for the two
/// lines of a contact (LineSampling), for two surfaces (FaceSampling), for a surface and an obstacle (ObstacleSampling). Sides are numbered
/// as those of the surfaces. Local.
class MortarSampling {
 public:
  virtual ~MortarSampling() = default;

  /// Number of the multiplier's functions on a side, one for each of its first nodes. \param whole  the other face covers all of the side
  virtual int functions(int side, bool whole) const = 0;
  /// Mean of the two faces' normals at a node of a side, outward there; its own where nothing stands opposite, or the other is parallel.
  virtual Point meanNormal(int side, int node) const = 0;
  /// Quadrature points of a side, seen along one direction. They are split wherever a side of the other face begins.
  virtual MortarSamples sample(int side, const Point& normal) const = 0;
  /// Part of a side that the other face stands opposite to, where this is cheaper than sample(); nothing where it is not.
  virtual std::optional<double> covered(int, const Point&) const { return std::nullopt; }

  /// True if either face is curved anywhere and straight elements take part, whose shape cannot follow it.
  virtual bool isFaceted() const { return false; }
  /// True if the doubts of samples are estimates.
  virtual bool estimatesDoubt() const { return false; }
};

/// The sampling of two faces. \param onA  face A carries the conditions. Local.
std::unique_ptr<MortarSampling> samplingOf(const Mesh& mesh, const ContactSurface& contact, bool onA);

}  // namespace suture
