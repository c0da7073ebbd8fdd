#pragma once
#include <suture/condensed/CondensedPairs.hpp>
#include <suture/condensed/ContactGroup.hpp>
#include <suture/condensed/LinearisedGroup.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// The formulation Condensed Groups of the paper: the unknown is the trace on Gamma, and contact is condensed in the groups (17).
class CondensedProblem : public InterfaceProblem {
 public:
  using SchurMaker = std::function<std::unique_ptr<SchurComplement>()>;
  using GroupMaker = std::function<std::unique_ptr<ContactGroup>(const ContactGroup::Parts&)>;

  /// \param subdomains  of this rank, assembled, in ascending order of ids; they must outlive the problem
  /// \param group  makes the groups; empty: Exact
  /// Collective. \throws NumericalError
  CondensedProblem(CommPtr comm, const Partition& partition, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                   const LocalSolverMaker& solver, const SchurMaker& schur, ContactLaws laws = {}, const GroupMaker& group = {});

  const std::shared_ptr<const InterfaceSpace>& space() const override { return space_; }
  InterfaceState initialState() const override;
  InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const override;
  Evaluation evaluate(const InterfaceState& state, double resolution = 0.0) const override;
  std::vector<int> differing(const ContactStates& a, const ContactStates& b) const override;
  Linearisation linearise(const InterfaceState& state) const override;
  Teuchos::RCP<InterfaceOperator> withoutContact() const override;
  Recovered recover(const InterfaceState& state) const override;
  std::optional<BrokenField> brokenField(const InterfaceState& state, const std::vector<Vector>& corrections) const override;
  int pieces() const override { return pieces_; }
  int pairs() const override { return pairs_; }

  /// Null if no pair can change.
  const ContactProblem* contact() const override { return contact_.get(); }
  void rememberPath(const std::vector<BodyForces>& carried) override;

  const std::vector<std::unique_ptr<ContactGroup>>& groups() const { return groups_; }
  const ContactLaws& laws() const { return laws_; }

 private:
  friend class CondensedPairs;
  /// True if a law of the scene is not unilateral, so that groups cannot solve their contact problems themselves and pair states are given.
  bool isGiven() const { return laws_.restrictSliding() || !allSeparate_; }
  std::vector<Vector> traces(const MultiVector& trace) const;
  /// Place of a group among local problems and statuses.
  int placeOfGroup(int group) const { return static_cast<int>(plain_.size()) + group; }
  /// Places of a group's members among the subdomains of this rank.
  const std::vector<int>& membersOf(int group) const { return groupMembers_[group]; }
  /// A group linearised at a status; the last result is cached. Local.
  std::shared_ptr<const LinearisedGroup> linearised(int group, const std::vector<ContactState>& status) const;
  /// Adds this rank's part of F - S_0 U of the plain subdomains and returns their energy. Collective.
  double addPlain(const std::vector<Vector>& trace, Matrix& force) const;
  /// Adds this rank's part of F - S U for the pair states of `state` and returns its energy. Collective.
  /// \param each  called with the response of each group of this rank
  using EachGroup = std::function<void(int group, const ContactGroup::Response& response, const Vector& moved)>;
  double addLinear(const InterfaceState& state, const std::vector<Vector>& trace, Matrix& force, const EachGroup& each = {}) const;
  /// U.S U of each plain subdomain, identified by its place. Local.
  void addPlainEnergies(const std::vector<Vector>& trace, const std::function<void(int subdomain, double energy)>& add) const;
  Vector movedRows(int group, const InterfaceState& state) const;
  /// Adds the free values of a group's members, without rigid motions, and the forces of its pairs.
  void addGroup(int group, const ContactGroup::Response& response, const Vector& moved, std::vector<Vector>& freeValues,
                std::vector<PairForce>& pairs) const;

  CommPtr comm_;
  const std::vector<std::unique_ptr<Subdomain>>& subdomains_;
  ContactLaws laws_;
  int subdomainCount_;                                          // over all ranks
  std::vector<std::shared_ptr<const SubdomainProblem>> plain_;  // subdomains of T on this rank: local problems 0 ..
  std::vector<std::unique_ptr<ContactGroup>> groups_;           // the following local problems
  std::vector<int> plainSubdomain_;                             // place of each plain problem's subdomain in subdomains_
  std::vector<std::vector<int>> groupMembers_;                  // places of each group's members in subdomains_
  std::shared_ptr<const InterfaceSpace> space_;
  int pieces_ = 0, pairs_ = 0;
  bool allSeparate_ = true;  // no law keeps its pairs closed; the same on all ranks
  std::unique_ptr<CondensedPairs> contact_;
  mutable std::vector<std::shared_ptr<const LinearisedGroup>> linearised_;  // one per group
};

}  // namespace suture
