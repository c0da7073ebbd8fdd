#pragma once
#include <suture/precond/Preconditioner.hpp>
#include <suture/precond/Weighting.hpp>
#include <suture/precond/coarse/BalancingCoarse.hpp>
#include <suture/precond/coarse/CoarseSpace.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Balancing Neumann-Neumann, eq. (28)-(31) for S and (37)-(38) for S_0 (an operator with null entries):
///     M^-1 = Q + (I - Q S) T (I - S Q),   T = sum_i R_i^T D_i S_i^+ D_i^T R_i,   Q = Z E^-1 Z^T,   E = Z^T S Z,
/// with Z the columns D_i Z_i. For a residual orthogonal to Z this is the paper's sum of D_i (phi_i + z_i), with z chosen to minimise the
/// error in the S norm; in this form it is symmetric positive definite for every residual. S Z is stored, so an application does not apply
/// S. The condition number is C (1 + log H/h)^2. An application costs a Neumann solve per local problem and two coarse solves. Subclasses
/// may replace T by another symmetric operator.
class NeumannNeumann : public Preconditioner {
 public:
  static Schema schema();
  explicit NeumannNeumann(const Parameters& own);
  /// For programs with their own strategies.
  NeumannNeumann(std::unique_ptr<Weighting> weighting, std::unique_ptr<CoarseSpace> coarseSpace,
                 std::function<std::unique_ptr<LocalSolver>()> coarseSolver, int copies = 0);

  int coarseSize() const override { return coarse_ ? coarse_->size() : 0; }
  /// For T as above; a subclass with another T overrides it.
  double leastEigenvalue() const override { return coarseSize() > 0 ? 1.0 : 0.0; }

 protected:
  void doInitialize() override;
  void doCompute() override;
  void doApply(const MultiVector& r, MultiVector& z) const override;
  /// R_i Q r + S_i^+ D_i^T R_i (I - S Q) r: the residual on the right is orthogonal to the coarse space, so the local Neumann problems have
  /// solutions.
  std::optional<std::vector<Vector>> doBrokenCorrection(const MultiVector& r) const override;
  /// Sets up T for matrix(); the weighting is already set up. Collective.
  virtual void computeLocals();
  /// sum <- sum + this rank's part of T residual, both as overlap values. Collective.
  virtual void addLocals(const Matrix& residual, Matrix& sum) const;
  const Weighting& weighting() const { return *weighting_; }

 private:
  void balanceResidual() const;

  std::unique_ptr<Weighting> weighting_;
  std::unique_ptr<CoarseSpace> coarseSpace_;
  std::function<std::unique_ptr<LocalSolver>()> coarseSolver_;
  int copies_;
  LocalProblems locals_;  // local problems of the inverses
  std::vector<std::unique_ptr<LocalInverse>> inverses_;
  std::unique_ptr<BalancingCoarse> coarse_;
  mutable Matrix residual_, whole_, sum_, flux_, trace_;  // work space, so that an application does not allocate
  mutable Vector y_;
};

}  // namespace suture
