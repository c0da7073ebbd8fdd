#pragma once
#include <suture/interface/InterfaceContact.hpp>
#include <suture/interface/InterfaceProblem.hpp>
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
class ContactInterfaceProblem : public InterfaceProblem {
 public:
  using SchurMaker = std::function<std::unique_ptr<SchurComplement>()>;

  /// \param subdomains  of this rank, assembled, in ascending order of ids; they must outlive the problem. Collective.
  /// \throws NumericalError
  ContactInterfaceProblem(CommPtr comm, const Partition& partition, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                          const LocalSolverMaker& solver, const SchurMaker& schur, ContactLaws laws = {});

  const std::shared_ptr<const InterfaceSpace>& space() const override { return space_; }
  InterfaceState initialState() const override;
  InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const override;
  /// Pair forces are taken from the softer side.
  Evaluation evaluate(const InterfaceState& state, double resolution = 0.0) const override;
  Linearisation linearise(const InterfaceState& state) const override;
  int conform(InterfaceState& state) const override;
  void update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image = nullptr) const override;
  std::vector<int> differing(const ContactStates& a, const ContactStates& b) const override { return rows_->differing(a, b); }
  Recovered recover(const InterfaceState& state) const override;
  std::vector<Vector> interiors(const InterfaceState& state) const override;
  std::optional<BrokenField> brokenField(const InterfaceState& state, const std::vector<Vector>& corrections) const override;
  bool reloads() const override { return true; }
  void reload() override;
  bool rearranges() const override { return true; }
  void rearrange() override;
  void rememberPath(const std::vector<BodyForces>& carried) override {
    if (contact_) contact_->bodies().remember(carried);
  }
  int pieces() const override { return pieces_; }
  int pairs() const override { return pairs_; }
  const ContactProblem* contact() const override { return contact_.get(); }

 private:
  PairForce forceOf(int row, const InterfaceState& state, const Vector& force, const Vector& gaps) const;
  bool restrictsSliding() const { return pairs_ > 0 && laws_.restrictSliding(); }
  Vector shearStiffness() const;
  void connect();
  void takeLoads();
  void findContact();
  Vector movedRows(const InterfaceState& state) const { return contact_ ? contact_->movedRows(state) : Vector(); }

  CommPtr comm_;
  const std::vector<std::unique_ptr<Subdomain>>& subdomains_;
  ContactLaws laws_;
  std::vector<std::vector<int>> boundaries_;  // free unknowns of the subdomains on the interface
  std::vector<std::shared_ptr<SubdomainProblem>> locals_;
  std::shared_ptr<const InterfaceSpace> space_;  // without relations
  std::unique_ptr<InterfaceBalance> balance_;
  std::unique_ptr<InterfaceRows> rows_;
  std::unique_ptr<PairTangents> tangents_;
  std::unique_ptr<InterfaceContact> contact_;  // null if no pair can change
  int pieces_ = 0, pairs_ = 0;
};

}  // namespace suture
