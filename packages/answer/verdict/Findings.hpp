#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/ContactPiece.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace suture {

/// Replaces std::hypot, whose overflow protection is several times slower; called in loops over all nodes.
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
  Friction,  // from here on only if a contact restricts sliding
  Slip,
  Dissipation,
  Slide,  // from here on only if contact forces act
  Offset
};
constexpr int kQuantities = 18;

/// One evaluation of a quantity. Trivially copyable: sent as bytes.
struct Finding {
  double value = 0.0, bound = 0.0;
  int body = -1, other = -1;  ///< other: second body of a pair
  int pair = -1;
  Point place{0, 0, 0};
  bool made = false;

  /// Used fraction of the bound; infinite for NaN.
  double share() const {
    if (!made) return -1.0;
    if (value == 0.0 && bound >= 0.0) return 0.0;
    return value >= 0.0 && bound > 0.0 ? value / bound : std::numeric_limits<double>::infinity();
  }
};

/// Name in summary.json.
std::string nameOf(Quantity quantity);
/// Value above which a run warns although the quantity is within its bound; infinite: never.
double doubtOf(Quantity quantity);
/// Advice if the bound is exceeded; empty for advice on the solver if `converged` is false.
/// \param byMonolithic  the solution is that of Monolithic
std::string adviceOf(Quantity quantity, bool byMonolithic = false, bool converged = true);
/// Body or pair, with position and names; empty if nothing was found.
std::string whereText(const Finding& finding, const std::vector<std::string>& bodies, const std::vector<ContactPiece>& pieces,
                      int dimension);

/// The worst finding of each quantity.
class Findings {
 public:
  /// \param size  measured value;  \param allowed  bound in the same unit;  \param scale  reference value for both. If round-off makes the
  /// bound larger than the scale, as for a body that only moves rigidly, the bound is the reference value.
  void take(Quantity quantity, double size, double allowed, double scale, Finding where) {
    const double unit = scale > allowed ? scale : allowed > 0.0 ? allowed : 1.0;
    where.value = size / unit;
    where.bound = allowed / unit;
    where.made = true;
    take(quantity, where);
  }
  /// True if take() would keep this value: cheaper than building a Finding for every node.
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
  double force = 0.0;                                  ///< force through the body: half of the sum, or its share of neighbours' forces
  double deformation = 0.0;                            ///< see Deformation [length]
  double lent = 0.0;                                   ///< part of `force` derived from neighbours [force]
  double rounded = 0.0;                                ///< ForceScale::rounded, for forces on the path of load steps so far [force]
  double places = 0.0;                                 ///< for an idle body: force at its pairs due to round-off of their positions [force]
  double residual = 0.0;                               ///< sum of magnitudes over the nodes [force]
  double rounding = 0.0;                               ///< sum over the nodes of eps |K| |u|: forces due to round-off of u [force]
  double spread = 0.0;                                 ///< root of the sum of squares of the same [force]

  /// True if no force acts on the body, up to round-off.
  bool isUnloaded() const;
  /// True if prescribed displacements only move the body as a whole: its forces are round-off of its displacements.
  bool carriesNothing() const;
  /// Multiple of eps |K| |u| by which forces of the body may deviate.
  double roundings() const;
};

/// A bound proportional to the tolerance, with an upper limit: relative to a body's own forces or deformation.
struct Bound {
  double factor, largest;
  /// Tolerances below 1e-9 count as 1e-9: below it, round-off of the largest stiffness dominates.
  double at(double tolerance) const { return std::min(factor * std::max(tolerance, 1e-9), largest); }
  /// Residual that solvers leave because they count these forces as round-off. [force]
  double ofRounding(const BodyScale& body) const { return factor * body.rounded + body.places; }
};

/// Bounds of the quantities. The tolerance refers to the energy norm, in which rough errors count less than in sums of nodal forces: the
/// factors are 2 (contact) to 100 (forces) times the largest values measured for correct solutions (doc/verification.md).
struct Bounds {
  static constexpr Bound resultant{100.0, 0.05}, residual{1000.0, 0.3}, node{100.0, 0.05}, contact{1000.0, 1.0}, pair{100.0, 0.05};
  static constexpr double rounding = 4.0;  ///< times eps |K| |u|
  static constexpr double nothing = 64.0;  ///< times eps |K| |u|: forces of a body that only moves rigidly
  static constexpr double places = 16.0;   ///< times eps |x|: gaps are differences of positions of several nodes
  static constexpr double digits = 1e-4;   ///< fraction of a body's forces or deformation that round-off may reach
  /// Largest slide of the partners of a pair, in elements: one, reduced for round-off of a slide of exactly one.
  static constexpr double slide = 0.99;
  /// Largest moment of contact forces across a gap, as a fraction of a body's force times its extent.
  static constexpr double offset = 0.05;
  static constexpr double rotation = 0.3;  ///< [rad] of a body that is hardly constrained: linear theory replaces a cosine of .955 by 1
  /// Fraction of a body's force that replaces its contact force as a scale if that is tiny: forces at nodes of open pairs are as small as
  /// the solver's residual (a layer bent by prescribed values without contact: 17 times what 1e-3 would allow).
  static constexpr double idle = 0.03;
  static constexpr double geometry = 1e-10;  ///< tolerance of prescribed values and seams, as a fraction of a body's deformation
};

inline bool BodyScale::isUnloaded() const {
  const double nothing = Bounds::residual.ofRounding(*this);
  return loads <= rounded && contact <= nothing && reactions + residual <= Bounds::nothing * rounding + nothing;
}
inline bool BodyScale::carriesNothing() const { return rounding > 0.0 && isUnloaded(); }
inline double BodyScale::roundings() const { return carriesNothing() ? Bounds::nothing : Bounds::rounding; }

}  // namespace suture
