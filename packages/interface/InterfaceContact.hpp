#pragma once
#include <suture/interface/ContactProblem.hpp>
#include <suture/interface/InterfaceBalance.hpp>
#include <suture/interface/InterfaceRows.hpp>
#include <suture/interface/PairTangents.hpp>
#include <suture/interface/SupportEnergy.hpp>
#include <suture/interface/TraceMotions.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Contact On The Interface pair by pair: forces and jumps of given states, with rigid motions of bodies kept apart from the trace.
class InterfaceContact : public ContactProblem {
 public:
  /// All arguments must outlive it; `subdomains` are assembled. Collective.
  InterfaceContact(const CommPtr& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains, const InterfaceSpace& space,
                   const ContactLaws& laws, const InterfaceRows& rows, const InterfaceBalance& balance, PairTangents& tangents);

  const ContactBodies& bodies() const override { return *bodies_; }
  ContactBodies& bodies() { return *bodies_; }
  const ContactLaws& laws() const override { return laws_; }
  const std::vector<FrictionSite>& sites() const override { return sites_; }
  ContactStates statusOf(const PairStates& pairs) const override;
  PairStates statesOf(const ContactStates& status) const override;
  PairValues valuesOf(const InterfaceState& state) const override;
  InterfaceState stateWith(const PairStates& pairs) const override;
  InterfaceState padState() const override { return stateOnPads(*rigid_); }
  const std::vector<int>& partOfOwned() const override { return partOfOwned_; }
  void separate(InterfaceState& state) const override;
  int remember(InterfaceState& state) const override;
  Vector energies(const InterfaceState& state) const override;

  /// Contribution of a state's rigid motions to the rows that this rank sees; empty if there are none.
  Vector movedRows(const InterfaceState& state) const;
  /// Work of the loads in a state's rigid motions.
  double rigidWork(const InterfaceState& state) const;
  /// Adds to a tangent the rigid motions that only springs of pairs hold. The same on all ranks. Collective.
  void addSpringMotions(const ContactStates& status, const InterfaceSpace& space, FrictionTangent& tangent) const;

 private:
  std::vector<FrictionSite> findSites() const;
  Matrix everywhere(const Matrix& ofRows) const { return rows_.everywhere(ofRows, bodies_->rigid().pairs()); }

  CommPtr comm_;
  const InterfaceSpace& space_;
  const ContactLaws& laws_;
  const InterfaceRows& rows_;
  const InterfaceBalance& balance_;
  PairTangents& tangents_;
  std::unique_ptr<ContactBodies> bodies_;
  RigidBodyModel* rigid_;  // the model of bodies_
  std::vector<int> partOfOwned_;
  std::unique_ptr<TraceMotions> motions_;
  std::unique_ptr<SupportEnergy> supports_;
  std::vector<FrictionSite> sites_;
};

}  // namespace suture
