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
  double residual = 0.0;             ///< sqrt(r.M r) / reference
  double reference = 0.0;            ///< norm that it is relative to: the given one, or that of the right-hand side
  double condition = 1.0;            ///< condition of M^-1 S, estimated from the Lanczos matrix of the CG coefficients
  double largestEigenvalue = 1.0;    ///< largest one of the same
  double smallestEigenvalue = 0.0;   ///< smallest one of the same, from above; 0: not known
  std::vector<double> energyErrors;  ///< estimates of |x - x_k|_S after each iteration, as history (see EnergyError); empty: not known
  bool enough = false;               ///< ended because EnergyCriterion said so
  std::vector<double> history;       ///< residual after each iteration, the first entry before them
  double seconds = 0.0;              ///< that the iterations took, with what the criterion asks
  std::vector<double> steps;         ///< step of each iteration along its search direction: x is the sum of steps times directions
};

/// A second reason to stop: the error in the energy norm is small enough.
struct EnergyCriterion {
  /// Asked after every iteration, on all ranks with the same numbers: the estimates of |x - x_0|_S and |x - x_k|_S, and x_k. May
  /// communicate.
  std::function<bool(double start, double error, const MultiVector& x)> enough = nullptr;
  double lowest = 0.0;  ///< smallest eigenvalue that earlier solves found of M^-1 S; 0: not known
};

/// Preconditioned conjugate gradients (Belos' PseudoBlockCGIter, with a status test of ours): stops when sqrt(r.M r) falls below
/// tolerance * reference. Belos' own managers stop on the Euclidean norm, which with jumps of stiffness or given displacements accepts
/// vectors that are no solution. A solve may be resumed: its state and Lanczos matrix are kept when it stops.
class InnerSolver {
 public:
  /// \param most  iterations at most, of one call
  explicit InnerSolver(int most = 1000);
  ~InnerSolver();
  InnerSolver(InnerSolver&&) noexcept;

  /// x <- approximation of S^-1 b, from x = 0. Collective.
  /// \param reference  norm that the tolerance refers to; 0: that of b itself
  /// \throws NumericalError  the operator or preconditioner is not positive definite
  InnerResult solve(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                    const MultiVector& b, MultiVector& x, double tolerance, double reference, Monitor& monitor,
                    const EnergyCriterion& energy = EnergyCriterion());

  /// True if goOn() may resume the last solve: it had something to do, and did not stop at the iteration limit. All ranks say
  /// the same.
  bool canGoOn() const;
  /// Goes on with the last solve: same operator, preconditioner (neither of them changed since) and right-hand side, no iteration lost.
  /// Collective.
  /// \param x  becomes what is added to the last answer, and what EnergyCriterion is asked about
  /// \param tolerance, reference, monitor, energy  as in solve(); the reference of 0 is still the norm of b
  /// \returns pcg, history and steps of this call only; eigenvalues and estimates of errors by all iterations since solve()
  InnerResult goOn(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy = EnergyCriterion());

 private:
  struct Solve;
  InnerResult iterate(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy);

  int most_;
  std::unique_ptr<Solve> solve_;  // the last one
};

/// sqrt(r.M r), the norm of residuals everywhere. Collective.
double preconditionedNorm(const Preconditioner& preconditioner, const MultiVector& r);

}  // namespace suture
