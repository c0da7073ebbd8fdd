#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/precond/Preconditioner.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// Cost and accuracy of an inner (linear) solve.
struct InnerResult {
  int pcg = 0;  ///< applications of the operator
  bool converged = false;
  double residual = 0.0;             ///< sqrt(r.M^-1 r) / reference
  double reference = 0.0;            ///< reference norm: the given one, or that of the right-hand side
  double condition = 1.0;            ///< condition number of M^-1 S, estimated from the Lanczos matrix of the CG coefficients
  double largestEigenvalue = 1.0;    ///< largest eigenvalue of that matrix
  double smallestEigenvalue = 0.0;   ///< smallest eigenvalue of that matrix, an upper bound; 0: unknown
  std::vector<double> energyErrors;  ///< estimates of |x - x_k|_S after each iteration, like history (see EnergyError); empty: unknown
  bool enough = false;               ///< ended by EnergyCriterion
  std::vector<double> history;       ///< initial residual, then the residual after each iteration
  double seconds = 0.0;              ///< time of the iterations, including the criterion
  std::vector<double> steps;         ///< step lengths: x is the sum of steps times search directions
};

/// Additional stopping criterion: the error in the energy norm is small enough.
struct EnergyCriterion {
  /// Called after every iteration, on all ranks with the same numbers: an estimate of |x - x_0|_S; the larger of sqrt(r.M^-1 r), which is
  /// the energy norm of the correction that balances the forces, and the estimate of |x - x_k|_S; and x_k. May communicate.
  std::function<bool(double start, double error, const MultiVector& x)> enough = nullptr;
  double lowest = 0.0;  ///< smallest eigenvalue of M^-1 S in earlier solves; 0: unknown
};

/// Preconditioned conjugate gradients (PseudoBlockCGIter of Belos with a custom status test): stops when sqrt(r.M^-1 r) falls below
/// tolerance
/// * reference. The solver managers of Belos stop on the Euclidean norm, which for jumps of stiffness or prescribed displacements accepts
/// vectors far from the solution. A solve can be resumed: its state and Lanczos matrix are kept when it stops.
class InnerSolver {
 public:
  /// \param most  maximum number of iterations per call
  explicit InnerSolver(int most = 1000);
  ~InnerSolver();
  InnerSolver(InnerSolver&&) noexcept;

  /// x <- approximation of S^-1 b, from x = 0. Collective.
  /// \param reference  reference norm of the tolerance; 0: the norm of b
  /// \throws NumericalError  if the operator or preconditioner is not positive definite
  InnerResult solve(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                    const MultiVector& b, MultiVector& x, double tolerance, double reference, Monitor& monitor,
                    const EnergyCriterion& energy = EnergyCriterion());

  /// True if goOn() may resume the last solve: it iterated and did not stop at the iteration limit. The same on all ranks.
  bool canGoOn() const;
  /// Resumes the last solve without losing an iteration: same operator, preconditioner (both unchanged) and right-hand side. Collective.
  /// \param x  out: increment of the last answer, also passed to EnergyCriterion
  /// \param tolerance, reference, monitor, energy  as in solve(); a reference of 0 is the norm of b
  /// \returns pcg, history and steps of this call only; eigenvalues and error estimates from all iterations since solve()
  InnerResult goOn(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy = EnergyCriterion());

 private:
  struct Solve;
  InnerResult iterate(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy);

  int most_;
  std::unique_ptr<Solve> solve_;  // the last solve
};

/// sqrt(r.M^-1 r), the residual norm used throughout. Collective.
double preconditionedNorm(const Preconditioner& preconditioner, const MultiVector& r);

}  // namespace suture
