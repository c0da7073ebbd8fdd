#pragma once
#include <suture/algebra/InverseWithBasis.hpp>
#include <suture/algebra/LocalSolver.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// The saddle-point problem of BDDC (see ConstrainedInverse) by a sparse factor of the stiffness matrix, without its Schur complement:
/// unknowns H that a constraint fixes alone are held, interior and all others are factored, and the other constraints C_2 enter through a
/// small matrix. If the held unknowns leave rigid motions, as many unknowns E as needed to fix these are excluded from the factor and join
/// the constraints in the small matrix. With F the factored unknowns and W = K_FF^-1 [K_FE, C_F^T]:
///
///     [ K_EE - K_EF W_E       (C_E - C_F W_E)^T ]   [x_E]   [f_E - W_E^T f_F]
///     [ C_E - C_F W_E           - C_F W_C       ] * [ m ] = [   - W_C^T f_F  ],    x_F = K_FF^-1 f_F - W [x_E; m].
///
/// gives the basis Phi, the traces of least energy. An application needs neither W nor m:
///
///     P f = (I - Phi C) [K_FF^-1 0; 0 0] (I - C^T Phi^T) f,
///
/// since f - C^T Phi^T f is in equilibrium with respect to all motions, and I - Phi C removes those that E and H leave. It costs a
/// back-substitution, which reads the factor: less than the dense inverse if the boundary is large compared with the interior, as in 3D;
/// and one pass over Phi each way, which BDDC makes anyway. Factor and Phi are stored in single precision if a trial shows little change.
/// Local.
class SparseConstrainedInverse : public InverseWithBasis {
 public:
  /// \param stiffness    symmetric, positive semidefinite, both triangles
  /// \param kernel       its null space, unknowns x motions
  /// \param boundary     positions of the trace
  /// \param constraints  rows x trace
  /// \throws NumericalError  a constraint depends linearly on the others, or the constraints leave a motion
  SparseConstrainedInverse(const SparseMatrix& stiffness, const Matrix& kernel, const std::vector<int>& boundary, const Matrix& constraints,
                           const LocalSolverMaker& solver, const std::string& what);

  ~SparseConstrainedInverse() override;

  void apply(ConstLocalView flux, LocalView trace) const override;
  void applyWithBasis(ConstLocalView flux, const Vector& told, const Vector& values, LocalView trace) const override;
  double bytesRead() const override;

 private:
  struct Unknowns;
  SparseMatrix columnsOf(const SparseMatrix& toApart, const std::vector<int>& rows) const;
  Matrix invertedSmall(const SparseMatrix& stiffness, const Unknowns& all, const Matrix& told, const std::string& what) const;
  /// trace <- P flux + Phi values; the values are added to every column. The second argument is Phi^T flux.
  void applyTo(ConstLocalView flux, const Eigen::Ref<const Matrix>& told, const Vector& values, LocalView trace) const;
  bool tryInSinglePrecision();

  SparseMatrix constraints_;                 // C^T: trace x constraints
  std::unique_ptr<LocalSolver> factor_;      // factor of F, or
  std::unique_ptr<SingleFactor> single_;     // the same in single precision
  int unknowns_ = 0;                         // size of F
  std::vector<std::pair<int, int>> places_;  // F on the trace: (position in the trace, among F)
};

}  // namespace suture
