#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/mortar/ShapeValues.hpp>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace suture {

/// A point of both faces of a contact, on a line along the normal of one of its conditions.
struct MortarSample {
  ReferencePoint at{0, 0, 0};   ///< reference coordinates on the side of the carrying face
  double weight = 0.0;          ///< quadrature weight [length or area]; axisymmetric: times 2 pi r [area]
  double gap = 0.0;             ///< distance to the other face along the normal [length]
  double doubt = 0.0;           ///< estimated error of the gap due to the element shape [length]
  int other = -1;               ///< side of the other face; -1: a rigid obstacle
  ShapeValues own{}, others{};  ///< shape functions of both sides at the point
};

/// Quadrature points of one side of the carrying face.
struct MortarSamples {
  std::vector<MortarSample> all;
  double covered = 0.0;  ///< fraction of the side that is opposite to the other face
  /// Largest value of each vertex's linear function on the covered part, i.e. how closely the other face approaches the vertex; 1 if it
  /// reaches it.
  ShapeValues reach{};

  /// Covered part from which on a side counts as covered entirely: quadratic functions of a multiplier have positive integrals there. Sides
  /// that end together as drawn cover each other except for a strain once they are loaded: they remain whole. All integrals are positive
  /// down to .94 (nine nodes, a corner uncovered), .89 (eight nodes), .75 (three nodes in 2D) and .11 (six nodes).
  static constexpr double kWhole = 0.95;
  /// Largest value of a node's hat function on the covered part below which the node carries no condition. At the end of a side on a smooth
  /// partner the pressure of like bodies behaves as r^-0.23: its mean weighted with the hat function of a node beyond the end is up to
  /// reach^-0.23 times the mean of a node at the end (2.5 % more here, 17 % more at one half, unbounded towards zero).
  static constexpr double kReach = 0.9;
};

/// Nodes where a face ends, with the direction of its rim there; zero at corners, and at the ends of lines. Local.
std::map<int, Point> rimOf(const Surface& surface);
/// Normal of the condition at a node: the mean of the two faces' outward normals, or the own one if they are antiparallel. A body usually
/// ends at an edge, which has no normal across it: across the rim of the own face the other normal counts, along it the mean, as for a
/// shaft in its bearing. Local. \param own, facing  at the node, and where the other face is opposite to it \param rim  direction of
/// rimOf() at the node; null: it is not on the rim
Point rowNormalOf(const Point& own, const Point& facing, const Point* rim);

/// Points at which the conditions of a mortar compare the carrying face with the other, in 2D and 3D. Implementations: two lines
/// (LineSampling), two surfaces (FaceSampling), a surface and an obstacle (ObstacleSampling). Sides are numbered as in the surfaces. Local.
class MortarSampling {
 public:
  virtual ~MortarSampling() = default;

  /// Number of multiplier functions on a side, one for each of its first nodes. \param whole  the other face covers the whole side
  virtual int functions(int side, bool whole) const = 0;
  /// Normal of the condition at a node of a side, outward; the side's own normal if nothing is opposite. A node that is as far beyond the
  /// end of the other face as nodes with a condition may be is opposite to that end: sides that end together as drawn overlap by a strain
  /// once they are loaded, with either sign.
  virtual Point rowNormal(int side, int node) const = 0;
  /// Quadrature points of a side along one direction, split wherever a side of the other face begins.
  virtual MortarSamples sample(int side, const Point& normal) const = 0;
  /// Covered fraction of a side, where this is cheaper than sample(); otherwise nothing.
  virtual std::optional<double> covered(int, const Point&) const { return std::nullopt; }

  /// True if either face is curved anywhere and straight elements, which cannot follow the curve, take part.
  virtual bool isFaceted() const { return false; }
  /// True if the samples contain estimates of `doubt`.
  virtual bool estimatesDoubt() const { return false; }
};

/// Sampling of two faces. \param onA  face A carries the conditions. Local.
std::unique_ptr<MortarSampling> samplingOf(const Mesh& mesh, const ContactSurface& contact, bool onA);

}  // namespace suture
