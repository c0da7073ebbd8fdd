#pragma once
#include <suture/search/ContactBalance.hpp>
#include <suture/search/LawProjection.hpp>
#include <suture/search/PadModel.hpp>

namespace suture {

/// States of pairs from rigid bodies on pads: they need no linear solve, and their forces always balance the loads. They are the initial
/// guess of a search, and replace states that would leave a body unconstrained. Local.
class PadStates {
 public:
  /// All arguments must outlive it.
  PadStates(const RigidBodyModel& rigid, const ContactLaws& laws, const LawProjection& projection);

  const PadModel& model() const { return pads_; }
  /// States at the drawn position. \param normal  receives the normal forces [force]
  PairStates start(Vector& normal) const;
  /// Equilibrium on the pads from forces and jumps of a solution. \param softness  factor on the compliance of the pads
  PadModel::Equilibrium equilibrium(const ContactBalance& at, double softness) const;
  /// True if a motion that all pairs together would stop is left free, or to a soft support alone, by these states.
  bool loosens(const PairStates& states) const;
  /// States at equilibrium(). \param now  states of the pairs that cannot change;  \return false: the pads have no equilibrium
  bool near(const ContactBalance& at, double softness, const PairStates& now, PairStates& found) const;

 private:
  PairStates states(const PadModel::Equilibrium& pads, PairStates now) const;

  const RigidBodyModel& rigid_;
  const ContactLaws& laws_;
  const LawProjection& projection_;
  PadModel pads_;
};

}  // namespace suture
