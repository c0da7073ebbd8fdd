#pragma once
#include <suture/precond/MortarAveraging.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/precond/PrimalRows.hpp>
#include <suture/precond/coarse/BddcCoarse.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Balancing domain decomposition by constraints (Dohrmann, 2003), with MortarRows and MortarAveraging across mortars:
///     M^-1 = sum_i R_i^T D_i x_i,   x_i = P_i f_i + Phi_i A_i y,   f_i = D_i^T R_i r,   (sum A_i^T Phi_i^T S_i Phi_i A_i) y = sum A_i^T
///     Phi_i^T f_i,
/// with P_i the inverse of S_i under the primal constraints C_i x = 0, Phi_i the traces of minimal energy with C_i Phi_i = I, and A_i the
/// map from primal unknowns to constraint values (PrimalConstraints). The method is additive: coarse and local problems see the same
/// residual. The condition number is C (1 + log H/h)^2, and all eigenvalues are at least one. An application costs a dense symmetric
/// product per local problem and one coarse solve, which is exact, or approximate with one more level for many local problems
/// (CoarseOptions). Local problems whose S_i and constraints did not change are not factored again; if only a few constraints changed, the
/// inverse is updated (UpdatedInverse).
class Bddc : public Preconditioner {
 public:
  static Schema schema();
  explicit Bddc(const Parameters& own);
  /// For programs with their own strategies.
  enum class Inverses { Automatic, Dense, Sparse };
  explicit Bddc(CoarseOptions levels, Inverses inverses = Inverses::Automatic);
  ~Bddc() override;

  int coarseSize() const override { return coarse_ ? coarse_->size() : 0; }
  double leastEigenvalue() const override { return 1.0; }
  double bytesRead() const override;
  std::string remark() const override;

 protected:
  void doInitialize() override;
  void doCompute() override;
  void doApply(const MultiVector& r, MultiVector& z) const override;
  std::optional<std::vector<Vector>> doBrokenCorrection(const MultiVector& r) const override;

 private:
  /// Calls each(i, x_i) for the local problems of this rank. Collective. \param r  one column
  template <typename Each>
  void solveLocals(const MultiVector& r, const Each& each) const;
  PrimalChoice choose();
  bool computeBroken(int locals, bool isBrokenHere);
  void factor(std::vector<PrimalRows> rows, int locals);
  std::unique_ptr<LocalInverse> inverseOf(const LocalProblem& local, const Matrix& rows) const;
  void factorLocals(std::vector<PrimalRows>& constraints);
  BddcCoarse::Inverses inverses() const;
  void countConstraints(const std::vector<Matrix>& rows);

  std::unique_ptr<Weighting> weighting_;
  std::unique_ptr<PrimalConstraints> primal_;
  CoarseOptions levels_;
  Inverses kind_;
  std::shared_ptr<const InterfaceSpace> broken_;  // space in which local problems share unknowns: the given one, or its broken one
  std::unique_ptr<MortarAveraging> averaging_;    // null if the space is not broken
  LocalProblems locals_;                          // local problems of the inverses
  // An inverse and its constraints.
  struct Constrained {
    std::shared_ptr<const PrimalRows::Rows> rows;
    std::shared_ptr<const LocalInverse> inverse;
  };
  std::vector<Constrained> present_;
  std::vector<Constrained> bases_;  // factored inverses; present_ holds these or updates of them
  std::unique_ptr<BddcCoarse> coarse_;
  struct Work;
  mutable std::unique_ptr<Work> work_;                   // work space, so that an application does not allocate
  GlobalId entityConstraints_ = 0, sharedUnknowns_ = 0;  // over all ranks
};

}  // namespace suture
