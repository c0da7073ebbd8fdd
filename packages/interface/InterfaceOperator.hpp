#pragma once
#include <suture/interface/InterfaceSpace.hpp>
#include <suture/subdomain/LocalProblem.hpp>

#include <Tpetra_Operator.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Local problems of this rank, in the order of the space's couplings. A null entry is a local problem that is left out: S_0 is the sum
/// over T only.
using LocalProblems = std::vector<std::shared_ptr<const LocalProblem>>;

/// A spring between interface unknowns: stiffness times (row . v)^2 / 2. Places in overlap().
struct InterfaceSpring {
  std::vector<int> places;
  std::vector<double> coefficients;
  double stiffness = 0.0;  ///< [force / length]
};

/// Contribution of frictional contact to the tangent for given pair states.
struct FrictionTangent {
  /// Relations of the virtual displacements if friction depends on normal forces (Coulomb): v_n + friction direction.v_t = 0 for a slipping
  /// pair; T'^T S T is not symmetric. Empty: those of the space.
  std::vector<InterfaceRelation> test;
  std::vector<InterfaceSpring> springs;  ///< springs that only this rank adds
  bool symmetric = true;                 ///< no friction depends on normal forces; in an operator: on no rank
  MultiVectorPtr motions{};              ///< rigid motions held only by springs, in unknowns of the space; null on all ranks: none
  Matrix motionEnergy{};                 ///< energy of the springs in these motions: motions x motions
};

/// The linear operator sum_i R_i^T S_i R_i over any subset of the local problems: S of (21), S_0 of (17), a tangent S_0 + S_KON'.
class InterfaceOperator : public Operator {
 public:
  /// \param friction  or null
  InterfaceOperator(std::shared_ptr<const InterfaceSpace> space, LocalProblems locals,
                    std::shared_ptr<const FrictionTangent> friction = nullptr);

  Teuchos::RCP<const Map> getDomainMap() const override { return space_->map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return space_->map(); }
  /// y <- alpha * sum_i R_i^T S_i R_i x + beta * y. Collective.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.0,
             double beta = 0.0) const override;
  bool hasTransposeApply() const override { return symmetric(); }
  /// The same on all ranks.
  bool symmetric() const { return !friction_ || friction_->symmetric; }

  const std::shared_ptr<const InterfaceSpace>& space() const { return space_; }
  const LocalProblems& locals() const { return locals_; }
  const FrictionTangent* friction() const { return friction_.get(); }  ///< null without friction
  /// Bytes of this rank's memory read by one application, as far as the local problems know. Local.
  double bytesRead() const;
  /// Number of applications so far (one per right-hand side).
  long long applications() const { return applications_; }

  /// Records the fluxes of all following applications until recorded() is called: this rank's part of sum_i R_i^T S_i R_i x before
  /// contributions of related unknowns are summed. For one right-hand side at a time.
  void record() const;
  /// Suspends recording during its lifetime: applications by a preconditioner do not belong to the solver.
  class Unrecorded {
   public:
    explicit Unrecorded(const InterfaceOperator& matrix) : matrix_(matrix), recording_(matrix.recording_) { matrix.recording_ = false; }
    ~Unrecorded() { matrix_.recording_ = recording_; }
    Unrecorded(const Unrecorded&) = delete;
    Unrecorded& operator=(const Unrecorded&) = delete;

   private:
    const InterfaceOperator& matrix_;
    const bool recording_;
  };
  /// Combination of the recorded fluxes with one coefficient per application: overlap x 1. Local.
  Matrix recorded(const std::vector<double>& coefficients) const;

  /// sum_i R_i^T condensedLoad_i: right-hand side of the operator. Collective.
  MultiVectorPtr condensedLoad() const;
  /// Number, over all ranks, of unknowns that no local problem of the subset touches: the operator is singular there. Collective.
  GlobalId untouched() const;

 private:
  void addSpring(const InterfaceSpring& spring) const;

  std::shared_ptr<const InterfaceSpace> space_;
  LocalProblems locals_;
  std::shared_ptr<const FrictionTangent> friction_;
  mutable long long applications_ = 0;
  int mostRows_ = 0;  // largest number of rows of a coupling
  mutable bool recording_ = false;
  mutable std::vector<Vector> recorded_;
  mutable Matrix overlap_, sum_, trace_, flux_;  // work space, so that an application allocates nothing
};

}  // namespace suture
