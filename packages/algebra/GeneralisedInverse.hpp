#pragma once
#include <suture/algebra/LocalSolver.hpp>

#include <memory>
#include <vector>

namespace suture {

/// A symmetric generalised inverse K^+ of a positive semidefinite stiffness matrix with a known kernel: K K^+ b = b for every b orthogonal
/// to the kernel. K^+ itself is positive definite.
///
/// Computed with fixing nodes: K + rho P, where P is the projection onto the kernel's values R_f at a few well-spread nodes (pivoted QR of
/// the kernel's rows), is positive definite, and its inverse is exact to round-off: for b orthogonal to the kernel R, R^T (K + rho P) x =
/// R^T b = 0 gives R_f^T x_f = 0, hence P x = 0. A shift of the whole diagonal would not be exact, and one spring too many would give wrong
/// results silently; therefore the result is verified: K R = 0, and K K^+ b = b for a random b.
class GeneralisedInverse {
 public:
  /// \param kernel   null space of K, unknowns x k; k = 0 for a regular matrix
  /// \param nodeOf   node of each unknown: all unknowns of a chosen node are fixed together
  /// \param what     for messages: "subdomain 'left 3'"
  /// \throws NumericalError  the matrix has a different kernel. Local.
  GeneralisedInverse(const SparseMatrix& matrix, const Matrix& kernel, const std::vector<int>& nodeOf, const LocalSolverMaker& maker,
                     const std::string& what);

  /// x <- K^+ x.
  void apply(LocalView x) const { solver_->solve(x); }

  int size() const { return size_; }
  const Matrix& kernel() const { return kernel_; }

 private:
  void verify(const SparseMatrix& matrix, const std::string& what) const;

  int size_;
  Matrix kernel_;
  std::unique_ptr<LocalSolver> solver_;
};

}  // namespace suture
