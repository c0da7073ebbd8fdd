#pragma once
#include <suture/base/Types.hpp>

#include <algorithm>

namespace suture {

/// Status of a contact pair: apart, or pressed together and sliding or stuck. Frictionless pairs that are closed slip: nothing keeps them
/// from sliding.
enum class PairStatus : int { Open = 0, Slip = 1, Stick = 2 };

/// State of a contact pair as its law decides it (ContactLaw::project): all that a solver, a checkpoint or a nested start need to go on
/// from. A status alone is the state of a pair without friction.
struct ContactState {
  PairStatus status = PairStatus::Open;
  Point direction{0, 0,
                  0};     ///< in which side A slides along side B, in the pair's frame, a unit vector; zero unless it slips with friction
  double bound = 0.0;     ///< largest tangential force without a normal one; 0 without friction [force]
  double friction = 0.0;  ///< by how much the normal force raises it: the slope of the law
  double across = 0.0;    ///< stiffness along acrossSlip(): of pairs that slip (FrictionSearch), of open ones (StateSearch) [force/length]

  ContactState() = default;
  ContactState(PairStatus s) : status(s) {}
  ContactState(PairStatus s, const Point& slides, double largest, double slope = 0.0)
      : status(s), direction(slides), bound(largest), friction(slope) {}

  bool closed() const { return status != PairStatus::Open; }
  /// True if the state makes an equation of row `component` of a ContactRow: of the normal one (0) where the pair is closed, of the
  /// tangential ones where it sticks.
  bool holds(int component) const { return component == 0 ? closed() : status == PairStatus::Stick; }
  /// True if another state makes equations of the same rows.
  bool holdsAs(const ContactState& other) const { return holds(0) == other.holds(0) && holds(1) == other.holds(1); }
  /// Largest tangential force under a normal one.
  double largest(double normal) const { return std::max(0.0, bound + friction * std::max(0.0, normal)); }
  /// True if a normal force on the pair drags it along.
  bool drags() const { return status == PairStatus::Slip && friction != 0.0; }

  friend bool operator==(const ContactState& a, const ContactState& b) {
    return a.status == b.status && a.direction == b.direction && a.bound == b.bound && a.friction == b.friction && a.across == b.across;
  }
  friend bool operator!=(const ContactState& a, const ContactState& b) { return !(a == b); }
};

/// The direction across that in which a pair slips in space, in its frame.
inline Point acrossSlip(const ContactState& state) { return {0.0, -state.direction[2], state.direction[1]}; }

}  // namespace suture
