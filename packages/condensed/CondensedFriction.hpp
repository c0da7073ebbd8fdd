#pragma once
#include <suture/interface/InterfaceProblem.hpp>

#include <vector>

namespace suture {

class CondensedProblem;
class CondensedSets;

/// Condensed Groups in terms of pair states with friction. Given states make the groups linear: sticking pairs are tied along their
/// tangents too, slipping pairs carry the bound of a Tresca problem. Bounds do not depend on normal forces within a linear problem, so the
/// condensed operator stays symmetric; Coulomb's law is the fixed point of such problems (TrescaFixedPoint).
class CondensedFriction : public FrictionStates {
 public:
  /// `problem`, with its groups already made, and `sets` must outlive it. Collective.
  CondensedFriction(const Comm& comm, const CondensedProblem& problem, const CondensedSets& sets);

  const ContactLaws& laws() const override;
  bool couplesToNormal() const override { return false; }
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
