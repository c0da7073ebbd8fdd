#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/Constraints.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace suture {

constexpr double unitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();

/// Not std::hypot: that guards against overflow, at several times the cost, and loops over all nodes call it.
inline double length(const Point& p) { return std::sqrt(dot(p, p)); }

/// The quantities of the verdict, in the order of summary.json.
enum class Quantity : int {
  Forces,
  Moments,
  Residual,
  Nodes,
  Contact,
  Prescribed,
  Seams,
  Penetration,
  Tension,
  Complementarity,
  Status,
  Digits,
  Rotation,
  Friction,  // from here on only where some contact restricts sliding
  Slip,
  Dissipation,
  Slide,  // from here on only where contact forces act
  Offset
};
constexpr int kQuantities = 18;

/// One evaluation of a quantity. Plain: it travels as bytes.
struct Finding {
  double value = 0.0, bound = 0.0;
  int body = -1, other = -1;  ///< other: of a pair between bodies
  int pair = -1;
  Point place{0, 0, 0};
  bool made = false;

  /// How much of the bound is used; infinite for NaN.
  double share() const {
    if (!made) return -1.0;
    if (value == 0.0 && bound >= 0.0) return 0.0;
    return value >= 0.0 && bound > 0.0 ? value / bound : std::numeric_limits<double>::infinity();
  }
};

/// Name in summary.json, and what to try when the bound is exceeded. \param byMonolithic  the answer is Monolithic's
std::string nameOf(Quantity quantity);
/// Value from which on a run warns, though the quantity is within its bound; infinite: never.
double doubtOf(Quantity quantity);
std::string adviceOf(Quantity quantity, bool byMonolithic = false);
/// Body or pair, with place and names; empty when nothing was found.
std::string whereText(const Finding& finding, const std::vector<std::string>& bodies, const std::vector<ContactPiece>& pieces,
                      int dimension);

/// The worst of each quantity.
class Findings {
 public:
  /// \param size  of what is measured;  \param allowed  in the same unit;  \param scale  what both are reported relative to, where positive
  void take(Quantity quantity, double size, double allowed, double scale, Finding where) {
    const double unit = scale > 0.0 ? scale : allowed > 0.0 ? allowed : 1.0;
    where.value = size / unit;
    where.bound = allowed / unit;
    where.made = true;
    take(quantity, where);
  }
  /// True if take() would keep this: cheaper than a Finding for every node.
  bool isWorse(Quantity quantity, double size, double allowed) const {
    const Finding& worst = all[std::size_t(quantity)];
    return !worst.made || !(size * worst.bound <= worst.value * allowed);
  }
  void take(Quantity quantity, const Finding& finding) {
    Finding& worst = all[std::size_t(quantity)];
    if (finding.share() > worst.share()) worst = finding;
  }
  void take(const Findings& other) {
    for (int q = 0; q < kQuantities; ++q) take(Quantity(q), other.all[std::size_t(q)]);
  }

  std::array<Finding, kQuantities> all;
};

/// Scales of a body's forces and displacements, summed over all ranks.
struct BodyScale {
  double loads = 0.0, contact = 0.0, reactions = 0.0;  ///< sums of magnitudes over the nodes [force]
  double largestContact = 0.0;                         ///< at a node [force]
  double largestNodal = 0.0;                           ///< load or contact force at a node [force]
  double prescribed = 0.0;                             ///< largest prescribed component [length]
  double force = 0.0;                                  ///< that passes through the body: half of the sum, or what neighbours lend it
  double deformation = 0.0;                            ///< see Deformation [length]
  double lent = 0.0;                                   ///< part of `force` that neighbours lend [force]
  double rounded = 0.0;                                ///< ForceScale::rounded, of forces on the path of load steps so far [force]
  double places = 0.0;    ///< of an idle body: force by which its pairs feel the rounding of their places [force]
  double residual = 0.0;  ///< sum of magnitudes over the nodes [force]
  double rounding = 0.0;  ///< sum over the nodes of eps |K| |u|: their forces by the last digits of u [force]
  double spread = 0.0;    ///< root of the squares of the same [force]

  /// True of a body that no force acts on, but for rounding.
  bool isUnloaded() const;
  /// True of a body that prescribed displacements only move as a whole: its forces are rounding of its displacements.
  bool carriesNothing() const;
  /// Multiple of eps |K| |u| by which forces of the body may be off.
  double roundings() const;
};

/// A bound that follows the tolerance, and ends somewhere: relative to a body's own forces or deformation.
struct Bound {
  double factor, largest;
  /// Tolerances below 1e-9 count as 1e-9: what is left then is rounding of the largest stiffness.
  double at(double tolerance) const { return std::min(factor * std::max(tolerance, 1e-9), largest); }
  /// What solvers leave of forces that they count as rounding. [force]
  double ofRounding(const BodyScale& body) const { return factor * body.rounded + body.places; }
};

/// Bounds of the quantities. The tolerance is one of the energy norm, in which rough errors count less than in sums of nodal forces: the
/// factors are some ten times what right answers were measured to need (README.md).
struct Bounds {
  static constexpr Bound resultant{100.0, 0.05}, residual{1000.0, 0.3}, node{100.0, 0.05}, contact{1000.0, 1.0}, pair{100.0, 0.05};
  static constexpr double rounding = 4.0;  ///< times eps |K| |u|
  static constexpr double nothing = 64.0;  ///< times eps |K| |u|: forces of a body that only moves
  static constexpr double places = 16.0;   ///< times eps |x|: gaps are differences of the places of several nodes
  static constexpr double digits = 1e-4;   ///< part of a body's forces or deformation that rounding may take
  /// Cells by which the partners of a pair may have slid along each other: one, less what rounds a slide of just one.
  static constexpr double slide = 0.99;
  /// Part of a body's force times its extent that the moment of contact forces across a gap may be.
  static constexpr double offset = 0.05;
  static constexpr double rotation = 0.3;  ///< [rad] of a body that hardly anything holds: a cosine of .955 is taken for 1
  /// Part of a body's force that its contact is measured by, where it hardly has one: forces at nodes of pairs that are open are as
  /// small as the solver's residual (a layer that prescribed values bend and nothing touches: 17 times what 1e-3 would allow).
  static constexpr double idle = 0.03;
  static constexpr double geometry = 1e-10;  ///< part of a body's deformation that prescribed values and seams may be off by
};

inline bool BodyScale::isUnloaded() const {
  const double nothing = Bounds::residual.ofRounding(*this);
  return loads <= rounded && contact <= nothing && reactions + residual <= Bounds::nothing * rounding + nothing;
}
inline bool BodyScale::carriesNothing() const { return rounding > 0.0 && isUnloaded(); }
inline double BodyScale::roundings() const { return carriesNothing() ? Bounds::nothing : Bounds::rounding; }

}  // namespace suture
