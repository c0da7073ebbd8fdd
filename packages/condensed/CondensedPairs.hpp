#pragma once
#include <suture/interface/ContactProblem.hpp>
#include <suture/interface/TraceMotions.hpp>

#include <memory>
#include <vector>

namespace suture {

class CondensedProblem;

/// Condensed Groups pair by pair. Given states make the groups linear; the states that the groups' contact problems have at the same trace
/// are proposed as the next ones, which is Newton's method on (17). With friction, sticking pairs are tied along their tangents too, and
/// slipping pairs carry the bound of a Tresca problem: bounds do not depend on normal forces within a linear problem, so the condensed
/// operator stays symmetric; Coulomb's law is the fixed point of such problems (TrescaFixedPoint). Rigid motions of bodies are kept apart
/// from the trace: for the groups they change the gaps.
class CondensedPairs : public ContactProblem {
 public:
  /// `problem`, with its groups already made, and its subdomains must outlive it. Collective.
  CondensedPairs(const Comm& comm, const CondensedProblem& problem, const std::vector<std::unique_ptr<Subdomain>>& subdomains);

  const ContactBodies& bodies() const override { return *bodies_; }
  ContactBodies& bodies() { return *bodies_; }
  const ContactLaws& laws() const override;
  const std::vector<FrictionSite>& sites() const override { return sites_; }
  bool couplesToNormal() const override { return false; }
  ContactStates statusOf(const PairStates& pairs) const override;
  PairStates statesOf(const ContactStates& status) const override;
  PairValues valuesOf(const InterfaceState& state) const override;
  PairStates proposal(const InterfaceState& state) const override;
  InterfaceState stateWith(const PairStates& pairs) const override;
  InterfaceState padState() const override { return stateOnPads(*rigid_); }
  const std::vector<int>& partOfOwned() const override { return partOfOwned_; }
  void separate(InterfaceState& state) const override;
  int remember(InterfaceState& state) const override;
  /// Subdomains without contact contribute the energy of the harmonic extension.
  Vector energies(const InterfaceState& state) const override;

  /// Contribution of a state's rigid motions to the rows of a group of this rank; empty if there are none.
  Vector movedRows(int group, const InterfaceState& state) const;
  /// Work of the loads in a state's rigid motions.
  double rigidWork(const InterfaceState& state) const;

 private:
  std::vector<FrictionSite> findSites() const;
  /// Sums values by pair, each known to one rank, over all ranks. Collective.
  Matrix everywhere(const Matrix& mine) const;
  Vector ofGroup(int group, const Vector& ofPairs) const;

  const Comm& comm_;
  const CondensedProblem& problem_;
  std::unique_ptr<ContactBodies> bodies_;
  RigidBodyModel* rigid_;  // the model of bodies_
  std::vector<int> partOfOwned_;
  std::unique_ptr<TraceMotions> motions_;
  std::vector<FrictionSite> sites_;
};

}  // namespace suture
