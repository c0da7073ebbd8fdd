#pragma once
#include <suture/interface/InterfaceProblem.hpp>

#include <vector>

namespace suture {

class CondensedProblem;
class CondensedSets;

/// Condensed Groups as states of pairs with friction. States make the groups linear: pairs that stick are glued along their tangents too,
/// those that slip feel the bound of a Tresca problem. Normal forces do not drag, so that the condensed operator stays symmetric: Coulomb's
/// law is the fixed point of such problems (FrictionOracle::drags).
class CondensedFriction : public FrictionStates {
 public:
  /// `problem`, whose groups are made, and its sets must outlive it. Collective.
  CondensedFriction(const Comm& comm, const CondensedProblem& problem, const CondensedSets& sets);

  const ContactLaws& laws() const override;
  bool drags() const override { return false; }
  ContactStates statusOf(const PairStates& pairs) const override;
  PairStates statesOf(const ContactStates& status) const override;
  PairValues valuesOf(const InterfaceState& state) const override;
  InterfaceState stateWith(const PairStates& pairs) const override;
  const std::vector<FrictionSite>& sites() const override { return sites_; }

 private:
  const Comm& comm_;
  const CondensedProblem& problem_;
  const CondensedSets& sets_;
  std::vector<FrictionSite> sites_;
};

}  // namespace suture
