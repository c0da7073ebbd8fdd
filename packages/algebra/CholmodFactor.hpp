#pragma once
#include <suture/base/Types.hpp>

#include <Eigen/SparseCore>
#include <memory>
#include <string>

namespace suture {

class SingleFactor;

/// Order and storage of CholmodFactor. The defaults suit plane problems.
struct CholmodOptions {
  /// Amd: of the leading block alone. Constrained Amd: of the whole graph, trailing dofs last, so that fill in their rows is weighed too.
  /// Metis: nested dissection of the leading block; pays in space. Automatic: Metis where nodes have three unknowns, else Amd.
  enum class Ordering { Automatic, Amd, ConstrainedAmd, Metis };
  /// The ordering with this name: "AMD", "METIS", or "Automatic".
  static Ordering orderingNamed(const std::string& name);
  /// Automatic: supernodal when the work per entry of the factor is large enough for dense blocks.
  enum class Form { Automatic, Simplicial, Supernodal };

  Ordering ordering = Ordering::Automatic;
  Form form = Form::Automatic;
  int trailing = 0;  ///< this many of the last dofs stay last, in the order given
  Vector shift;      ///< added to the diagonal of the trailing dofs before factoring; one entry each, or empty for none
};

/// Sparse Cholesky factorisation of a symmetric positive definite matrix, L L^T = A, through CHOLMOD.
///
/// Interior first, interface last, in ONE factorisation: with the dofs split into leading (I) and trailing (B) ones,
///     A = [A_II A_IB; A_BI A_BB],   L = [L_II 0; L_BI L_BB],   L_BB L_BB^T = A_BB - A_BI A_II^-1 A_IB + shift,
/// so that the same factor gives the Schur complement, the solves with A and those with A_II. The matrix of a floating body is singular,
/// but its Schur complement is not needed to be definite: the trailing diagonal is shifted before the factorisation and the shift taken
/// off again from L_BB L_BB^T. The error is that of rounding in the shifted diagonal; with the diagonal of A_BB itself as shift
/// (trailingDiagonal()) S times a translation vanishes to 1e-15 of S for 200 dofs, 1e-14 for 2000, 6e-14 for 20000 (measured).
///
/// Everything is local and const: several threads may solve with one factor.
class CholmodFactor {
 public:
  struct Statistics {
    int size = 0, trailing = 0;
    double factorEntries = 0.0;  ///< nonzeros of L
    double flops = 0.0;          ///< operations of the factorisation
    double bytes = 0.0;          ///< held by the factor
    bool supernodal = false;
    std::string ordering;
    double smallestPivot = 1.0;  ///< smallest l_jj^2 / a_jj (shift included): near rounding for a singular matrix
    int smallestPivotDof = -1;   ///< place of the smallest pivot
  };

  /// \param matrix  n x n, compressed columns; only the lower triangle is read (the upper may be there or not)
  /// \throws NumericalError   a pivot is not positive, or is nothing but rounding: the matrix is singular or indefinite; names the dof
  /// \throws EnvironmentError out of memory, or a factor beyond 2^31 entries
  /// \throws InternalError    not square, sizes of trailing and shift do not fit, an ordering that this CHOLMOD was built without
  explicit CholmodFactor(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options = CholmodOptions());
  ~CholmodFactor();
  CholmodFactor(CholmodFactor&&) noexcept;
  CholmodFactor& operator=(CholmodFactor&&) noexcept;

  int size() const;
  int trailing() const;

  /// rhs <- A^-1 rhs, A with the shift that it was factored with. n x right-hand sides.
  void solve(LocalView rhs) const;

  /// rhs <- A_II^-1 rhs: trailing dofs held. (n - trailing) x right-hand sides. Touches L_II only.
  void solveLeading(LocalView rhs) const;

  /// S = A_BB - A_BI A_II^-1 A_IB, without the shift. trailing x trailing, both triangles.
  Matrix trailingSchur() const;

  const Statistics& statistics() const;

  /// The factor of a matrix without trailing dofs in single precision; null if it has no supernodes.
  std::unique_ptr<SingleFactor> inSinglePrecision() const;

  /// The last `trailing` entries of the diagonal: the shift for floating bodies.
  static Vector trailingDiagonal(const Eigen::SparseMatrix<double>& matrix, int trailing);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace suture
