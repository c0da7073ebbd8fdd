#pragma once
#include <suture/base/Types.hpp>

#include <algorithm>

namespace suture {

/// Status of a contact pair: open, or closed and slipping or sticking. Closed frictionless pairs slip: nothing prevents them from
/// sliding.
enum class PairStatus : int { Open = 0, Slip = 1, Stick = 2 };

/// State of a contact pair as decided by its law (ContactLaw::project): all data that a solver, a checkpoint or a nested start needs to
/// continue. A status alone is the state of a frictionless pair.
struct ContactState {
  PairStatus status = PairStatus::Open;
  Point direction{0, 0,
                  0};  ///< direction in which side A slides along side B, in the pair's frame, a unit vector; zero without frictional slip
  double bound = 0.0;  ///< largest tangential force at zero normal force; 0 without friction [force]
  double friction = 0.0;             ///< slope of the law: increase of the bound per normal force
  double transverseStiffness = 0.0;  ///< along acrossSlip(), of slipping pairs and of open pairs that hold a neutral motion [force/length]

  ContactState() = default;
  ContactState(PairStatus s) : status(s) {}
  ContactState(PairStatus s, const Point& slides, double largest, double slope = 0.0)
      : status(s), direction(slides), bound(largest), friction(slope) {}

  bool closed() const { return status != PairStatus::Open; }
  /// True if the state turns row `component` of a ContactRow into an equation: the normal row (0) if the pair is closed, the tangential
  /// rows if it sticks.
  bool holds(int component) const { return component == 0 ? closed() : status == PairStatus::Stick; }
  /// True if the other state makes equations of the same rows.
  bool holdsAs(const ContactState& other) const { return holds(0) == other.holds(0) && holds(1) == other.holds(1); }
  /// Largest tangential force at a given normal force.
  double largest(double normal) const { return std::max(0.0, bound + friction * std::max(0.0, normal)); }
  /// True if the normal force on the pair changes its tangential force.
  bool couplesToNormal() const { return status == PairStatus::Slip && friction != 0.0; }

  friend bool operator==(const ContactState& a, const ContactState& b) {
    return a.status == b.status && a.direction == b.direction && a.bound == b.bound && a.friction == b.friction &&
           a.transverseStiffness == b.transverseStiffness;
  }
  friend bool operator!=(const ContactState& a, const ContactState& b) { return !(a == b); }
};

/// Direction perpendicular to the slip of a pair in 3D, in its frame.
inline Point acrossSlip(const ContactState& state) { return {0.0, -state.direction[2], state.direction[1]}; }

}  // namespace suture
