#pragma once
#include <suture/algebra/InverseWithBasis.hpp>
#include <suture/algebra/LocalSolver.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// The saddle problem of BDDC (see ConstrainedInverse) by a sparse factor of the stiffness matrix, without its Schur complement: unknowns
/// that a constraint fixes alone are held, interior and all others are factored, and the other constraints C_2 follow through a small
/// matrix. Where the held unknowns leave motions, as many unknowns E as these need are kept apart from the factor and join the constraints
/// in the small matrix. With F the factored unknowns and W = K_FF^-1 [K_FE, C_F^T]:
///
///     [ K_EE - K_EF W_E       (C_E - C_F W_E)^T ]   [x_E]   [f_E - W_E^T f_F]
///     [ C_E - C_F W_E           - C_F W_C       ] * [ m ] = [   - W_C^T f_F  ],    x_F = K_FF^-1 f_F - W [x_E; m].
///
/// An application is a back-substitution, which reads what the factor has: less than the dense inverse where the boundary is large against
/// the interior, as in space. The factor is kept in single precision where that changes little: that is tried. Local.
class SparseConstrainedInverse : public InverseWithBasis {
 public:
  /// \param stiffness    symmetric, positive semidefinite, both triangles
  /// \param kernel       its null space, unknowns x motions
  /// \param boundary     positions of the trace
  /// \param constraints  rows x trace
  /// \throws NumericalError  a constraint follows from the others, or they leave a motion
  SparseConstrainedInverse(const SparseMatrix& stiffness, const Matrix& kernel, const std::vector<int>& boundary, const Matrix& constraints,
                           const LocalSolverMaker& solver, const std::string& what);

  ~SparseConstrainedInverse() override;

  void apply(ConstLocalView flux, LocalView trace) const override;
  double bytesRead() const override;

 private:
  struct Unknowns;
  Matrix smallMatrix(const SparseMatrix& stiffness, const Unknowns& all, const Matrix& columns, const Matrix& images) const;
  void tryInSinglePrecision(double jump);

  std::unique_ptr<LocalSolver> factor_;      // factor of F, or
  std::unique_ptr<SingleFactor> single_;     // the same in single precision
  int unknowns_ = 0;                         // number of F
  std::vector<std::pair<int, int>> places_;  // F on the trace: (position in the trace, among F)
  std::vector<std::pair<int, int>> apart_;   // E on the trace: (position in the trace, among E)
  int motions_ = 0;                          // number of E
  PackedColumns images_;                     // W on the trace; rows of E and of what is held are zero
  Matrix small_;                             // inverse of the small matrix
};

}  // namespace suture
