#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Status of a contact pair: apart, or pressed together and sliding or stuck. Frictionless pairs that are closed slip: nothing keeps them
/// from sliding.
enum class PairStatus : int { Open = 0, Slip = 1, Stick = 2 };

/// State of a contact pair as its law decides it (ContactLaw::project): all that a solver, a checkpoint or a nested start need to go on
/// from. A status alone is the state of a pair without friction.
struct ContactState {
  PairStatus status = PairStatus::Open;
  Point direction{0, 0, 0};  ///< in which side A slides along side B, a unit vector; zero without friction
  double bound = 0.0;        ///< largest tangential force; 0 without friction [force]

  ContactState() = default;
  ContactState(PairStatus s) : status(s) {}
  ContactState(PairStatus s, const Point& slides, double largest) : status(s), direction(slides), bound(largest) {}

  bool closed() const { return status != PairStatus::Open; }
  /// True if the state makes an equation of row `component` of a ContactRow: of the normal one (0) where the pair is closed, of the
  /// tangential ones where it sticks.
  bool holds(int component) const { return component == 0 ? closed() : status == PairStatus::Stick; }

  friend bool operator==(const ContactState& a, const ContactState& b) {
    return a.status == b.status && a.direction == b.direction && a.bound == b.bound;
  }
  friend bool operator!=(const ContactState& a, const ContactState& b) { return !(a == b); }
};

}  // namespace suture
