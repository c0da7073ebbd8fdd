#pragma once
#include <suture/interface/ContactClusters.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/interface/PairForces.hpp>
#include <suture/interface/PairTangents.hpp>
#include <suture/interface/SupportEnergy.hpp>
#include <suture/interface/TraceMotions.hpp>
#include <suture/pairs/ContactRow.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// The formulation Contact On The Interface, without groups. The normal components of contact nodes are interface unknowns in addition to
/// those of the seams; a closed pair identifies two of them (up to the gap). Contact changes the interface but no local problem, and a
/// contact line may be partitioned and distributed over ranks like any other line.
///
/// With the contact rows N, the gaps g and S = sum R_i^T S_i R_i over the subdomains: S U + N^T f = F, f >= 0, g - N U >= 0, f.(g - N U) =
/// 0. For a set of closed pairs, T spans the null space of their rows, and the linear problem is T^T S T w = T^T (F - S U) starting from a
/// U that satisfies the rows.
class ContactInterfaceProblem : public InterfaceProblem, public ContactSets, public FrictionStates {
 public:
  using SchurMaker = std::function<std::unique_ptr<SchurComplement>()>;

  /// \param subdomains  of this rank, assembled, in ascending order of ids; they must outlive the problem. Collective.
  /// \throws NumericalError
  ContactInterfaceProblem(CommPtr comm, const Partition& partition, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                          const LocalSolverMaker& solver, const SchurMaker& schur, ContactLaws laws = {});

  const std::shared_ptr<const InterfaceSpace>& space() const override { return space_; }
  InterfaceState initialState() const override;
  InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const override;
  /// The next set is that of semismooth Newton: a closed pair opens if its force is tensile, an open pair closes if it penetrates. Forces
  /// are taken from the softer side.
  Evaluation evaluate(const InterfaceState& state, double resolution = 0.0) const override { return evaluateSet(state, {resolution}); }
  Linearisation linearise(const InterfaceState& state) const override;
  int conform(InterfaceState& state) const override;
  void update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image = nullptr) const override;
  std::vector<int> differing(const ContactStates& a, const ContactStates& b) const override;
  Recovered recover(const InterfaceState& state) const override;
  std::vector<Vector> interiors(const InterfaceState& state) const override;
  bool reloads() const override { return true; }
  void reload() override;
  void rememberPath(const std::vector<BodyForces>& carried) override {
    if (bodies_) bodies_->remember(carried);
  }
  int pieces() const override { return pieces_; }
  int pairs() const override { return pairs_; }

  const ContactSets* sets() const override { return bodies_ ? this : nullptr; }
  const ContactBodies& bodies() const override { return *bodies_; }
  ContactStates statusOf(const ClosedSet& closed) const override;
  ClosedSet closedSet(const ContactStates& status) const override;
  Evaluation evaluateSet(const InterfaceState& state, PairResolution resolution) const override;
  InterfaceState padState() const override;
  void move(InterfaceState& state, const Vector& motion) const override;
  const std::vector<int>& partOfOwned() const override { return partOfOwned_; }
  void separate(InterfaceState& state) const override;
  int remember(InterfaceState& state) const override;
  Vector energies(const InterfaceState& state) const override;

  const FrictionStates* friction() const override { return bodies_ && rubs_ ? this : nullptr; }
  const ContactLaws& laws() const override { return laws_; }
  ContactStates statusOf(const PairStates& pairs) const override;
  PairStates statesOf(const ContactStates& status) const override;
  PairValues valuesOf(const InterfaceState& state) const override;
  InterfaceState stateWith(const PairStates& pairs) const override;
  const std::vector<FrictionSite>& sites() const override { return sites_; }

 private:
  void findSites();
  /// Tangential jumps of a row's pair, by component.
  Point slipOf(int row, const Vector& gaps) const;
  /// Adds to an imbalance the known tangential forces of slipping pairs and the forces of transverse springs.
  void addSlipForces(const InterfaceState& state, const Matrix& trace, Matrix& imbalance) const;
  /// Finds on all ranks the motions that only springs of pairs hold. Collective.
  void addSpringMotions(const ContactStates& status, const InterfaceSpace& space, FrictionTangent& tangent) const;
  /// \param force, gaps  of all rows
  PairForces pairForces(int row, const Vector& force, const Vector& gaps) const;
  ContactState pressed(const ContactRow& row) const;
  InterfaceState allClosed() const;
  void takeLoads();
  void collectRows(const Vector& stiffness);
  void findBodies();
  /// Contribution of a state's rigid motions to the rows that this rank sees; empty if there are none.
  Vector movedRows(const InterfaceState& state) const;
  /// Work of the loads in a state's rigid motions.
  double rigidWork(const InterfaceState& state) const;
  /// Sums values of this rank's own rows over all ranks, by pair id. Collective.
  Matrix everywhere(const Matrix& ofRows) const;
  /// S U - F on the overlap, complete; `applications` is incremented. Collective.
  Matrix imbalance(const MultiVector& trace) const;
  Matrix rememberedImbalance(const InterfaceState& state, int& applications) const;
  /// T^T of an imbalance, with the sign of a residual.
  MultiVectorPtr residual(const Matrix& imbalance, const InterfaceSpace& space, const FrictionTangent* friction = nullptr) const;

  CommPtr comm_;
  const std::vector<std::unique_ptr<Subdomain>>& subdomains_;
  ContactLaws laws_;
  std::vector<std::shared_ptr<SubdomainProblem>> locals_;
  std::shared_ptr<const InterfaceSpace> space_;  // without relations
  Teuchos::RCP<InterfaceOperator> apart_;        // S on space_: all pairs open
  std::vector<ContactRow> rows_;                 // rows that this rank sees, by pair
  std::vector<char> owned_;                      // marks the rows that this rank owns; each row has one owner
  std::unique_ptr<ContactClusters> clusters_;
  std::unique_ptr<ContactBodies> bodies_;  // null if no pair can change
  std::vector<int> partOfOwned_;
  std::unique_ptr<TraceMotions> motions_;
  std::unique_ptr<SupportEnergy> supports_;
  Matrix load_;                  // F on the overlap, complete
  double constantEnergy_ = 0.0;  // over all ranks
  int pieces_ = 0, pairs_ = 0;
  std::unique_ptr<PairTangents> tangents_;
  bool rubs_ = false;  // a law restricts sliding; the same on all ranks
  std::vector<FrictionSite> sites_;
};

}  // namespace suture
