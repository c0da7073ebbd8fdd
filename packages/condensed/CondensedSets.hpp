#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/interface/TraceMotions.hpp>

#include <memory>
#include <vector>

namespace suture {

class CondensedProblem;

/// Condensed Groups in terms of sets of closed pairs. For a given set the groups are linear; the set that their contact problems have at
/// the same trace is proposed as the next one, which is Newton's method on (17). Rigid motions of bodies are kept apart from the trace: for
/// the groups they change the gaps.
class CondensedSets : public ContactSets {
 public:
  /// `problem`, with its groups already made, and its subdomains must outlive it. Collective.
  CondensedSets(const Comm& comm, const CondensedProblem& problem, const std::vector<std::unique_ptr<Subdomain>>& subdomains);

  const ContactBodies& bodies() const override { return *bodies_; }
  void rememberPath(const std::vector<BodyForces>& carried) { bodies_->remember(carried); }
  ContactStates statusOf(const ClosedSet& closed) const override;
  ClosedSet closedSet(const ContactStates& status) const override;
  InterfaceEvaluation evaluateSet(const InterfaceState& state, PairResolution resolution) const override;
  ClosedSet proposal(const InterfaceState& state) const override;
  InterfaceState padState() const override;
  void move(InterfaceState& state, const Vector& motion) const override;
  const std::vector<int>& partOfOwned() const override { return partOfOwned_; }
  void separate(InterfaceState& state) const override;
  int remember(InterfaceState& state) const override;
  /// Subdomains without contact contribute the energy of the harmonic extension.
  Vector energies(const InterfaceState& state) const override;

  /// Contribution of a state's rigid motions to the rows of a group of this rank; empty if there are none.
  Vector movedRows(int group, const InterfaceState& state) const;
  /// Work of the loads in a state's rigid motions.
  double rigidWork(const InterfaceState& state) const;
  /// Sums values by pair, each known to one rank, over all ranks. Collective.
  Matrix everywhere(const Matrix& mine) const;

 private:
  Vector ofGroup(int group, const Vector& ofPairs) const;

  const Comm& comm_;
  const CondensedProblem& problem_;
  std::unique_ptr<ContactBodies> bodies_;
  std::vector<int> partOfOwned_;
  std::unique_ptr<TraceMotions> motions_;
};

}  // namespace suture
