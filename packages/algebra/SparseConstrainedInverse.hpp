#pragma once
#include <suture/algebra/LocalInverse.hpp>
#include <suture/algebra/LocalSolver.hpp>
#include <suture/algebra/PackedColumns.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// The saddle problem of BDDC (see ConstrainedInverse) by a sparse factor of the stiffness matrix, without its Schur complement: unknowns
/// that a constraint fixes alone are held, interior and all others are factored, and the other constraints C_2 follow through the small
/// matrix C_2 K^-1 C_2^T. An application is a back-substitution, which reads what the factor has: less than the dense inverse where the
/// boundary is large against the interior, as in space. Local.
class SparseConstrainedInverse : public LocalInverse {
 public:
  /// \param stiffness    symmetric, positive semidefinite, both triangles
  /// \param boundary     positions of the trace
  /// \param constraints  rows x trace
  /// \return null if the held unknowns alone leave a motion: the matrix that is factored would be singular
  /// \throws NumericalError  a constraint follows from the others
  static std::unique_ptr<SparseConstrainedInverse> make(const SparseMatrix& stiffness, const std::vector<int>& boundary,
                                                        const Matrix& constraints, const LocalSolverMaker& solver, const std::string& what);

  void apply(ConstLocalView flux, LocalView trace) const override;
  Matrix basis() const override { return basis_.full(); }
  const Matrix& energy() const override { return energy_; }
  void applyBasisTransposed(const Eigen::Ref<const Vector>& flux, Vector& values) const override {
    basis_.multiplyTransposed(flux, values);
  }
  void addBasis(const Vector& values, Eigen::Ref<Vector> trace) const override { basis_.addProduct(values, trace); }
  double basisBytesRead() const override { return 2.0 * basis_.bytes(); }

 private:
  SparseConstrainedInverse() = default;

  std::unique_ptr<LocalSolver> factor_;      // of the free unknowns
  int unknowns_ = 0;                         // their number
  std::vector<std::pair<int, int>> places_;  // free unknowns of the trace: (position in the trace, among the free unknowns)
  Matrix images_;                            // K^-1 C_2^T: free unknowns x other constraints
  Matrix shares_;                            // (C_2 K^-1 C_2^T)^-1
  PackedColumns basis_;
  Matrix energy_;
};

}  // namespace suture
