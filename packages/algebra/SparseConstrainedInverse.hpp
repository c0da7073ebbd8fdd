#pragma once
#include <suture/algebra/InverseWithBasis.hpp>
#include <suture/algebra/LocalSolver.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// The saddle problem of BDDC (see ConstrainedInverse) by a sparse factor of the stiffness matrix, without its Schur complement: unknowns
/// that a constraint fixes alone are held, interior and all others are factored, and the other constraints C_2 follow through the small
/// matrix C_2 K^-1 C_2^T. An application is a back-substitution, which reads what the factor has: less than the dense inverse where the
/// boundary is large against the interior, as in space. Local.
class SparseConstrainedInverse : public InverseWithBasis {
 public:
  /// \param stiffness    symmetric, positive semidefinite, both triangles
  /// \param boundary     positions of the trace
  /// \param constraints  rows x trace
  /// \return null if the held unknowns alone leave a motion: the matrix that is factored would be singular
  /// \throws NumericalError  a constraint follows from the others
  static std::unique_ptr<SparseConstrainedInverse> make(const SparseMatrix& stiffness, const std::vector<int>& boundary,
                                                        const Matrix& constraints, const LocalSolverMaker& solver, const std::string& what);

  void apply(ConstLocalView flux, LocalView trace) const override;

 private:
  SparseConstrainedInverse() = default;

  std::unique_ptr<LocalSolver> factor_;      // factor of the free unknowns
  int unknowns_ = 0;                         // number of free unknowns
  std::vector<std::pair<int, int>> places_;  // free unknowns of the trace: (position in the trace, among the free unknowns)
  Matrix images_;                            // K^-1 C_2^T: free unknowns x other constraints
  Matrix shares_;                            // (C_2 K^-1 C_2^T)^-1
};

}  // namespace suture
