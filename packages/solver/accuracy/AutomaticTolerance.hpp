#pragma once
#include <suture/answer/error/ErrorEstimate.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/solver/InnerSolver.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace suture {

/// `Outer Solver/Tolerance` = Automatic: iterations end once the solver error is below the discretisation error. The target of the
/// algebraic part, sqrt(r.M^-1 r) in the energy norm, is a tenth of the discretisation error. Both parts add in squares, so the total error
/// is then at most 0.5 % larger than the latter. (Once the pairs have settled, an iterate solves the contact problem under loads that
/// differ by its residual, so the error is that of a linear problem.)
///
/// Methods by pair states use the target as their tolerance, relative to the energy norm of the solution: pair states are decided, and
/// residuals confirmed, as with a given number. An estimate of the discretisation error costs as much as many iterations. Hence the first
/// one is made where the iterations would end by the error that a coarser mesh predicts, or by one that is expected for a mesh of this
/// size. If the estimate is not smaller, the iterations end, and the solution recovered for the estimate is the answer. Otherwise they
/// continue to a tenth of the estimate. It is repeated only if pairs have changed, or if the algebraic error was more than half of it
/// (errors add in squares, so it may have been more than 13 % too large).
class AutomaticTolerance {
 public:
  static constexpr double kShare = 0.1;                       ///< algebraic part of the discretisation error
  static constexpr double kTightest = 1e-8, kLoosest = 1e-2;  ///< limits of the tolerance

  /// Tolerance for a relative discretisation error. Local.
  static double toleranceFor(double relative) { return std::clamp(kShare * relative, kTightest, kLoosest); }

  struct Estimate {
    std::function<DiscretisationError(const std::vector<Vector>& freeValues)> of;  ///< error of this rank's subdomains; collective
    double expected = 0.0;                                                         ///< a priori guess, relative to the norm of the solution
    double predicted = 0.0;  ///< from a coarser mesh, in the energy norm, replaces the guess; 0: unknown
  };
  using Recovered = std::shared_ptr<const InterfaceProblem::Recovered>;

  /// \param estimate  empty: no automatic tolerance, no iteration is ended. `problem` must outlive this.
  AutomaticTolerance(const InterfaceProblem& problem, Estimate estimate) : problem_(problem), estimate_(std::move(estimate)) {}

  bool on() const { return estimate_.of != nullptr; }
  const std::optional<DiscretisationError>& last() const { return last_; }
  int estimates() const { return estimates_; }
  /// Recovered solution of the estimate at the end of the last solve, returned once; else null.
  Recovered takeRecovered() { return std::exchange(recovered_, nullptr); }

  /// Sets the energy norm of the solution, at first approximately.
  void startsFrom(double norm) { scale_ = norm; }
  /// Smallest eigenvalue of M^-1 S found so far: below 1 the algebraic error may be larger than sqrt(r.M^-1 r).
  void learn(double lowest) { lowest_ = lowest; }
  /// Bound of sqrt(r.M^-1 r) relative to the energy norm of the solution, by the current estimate, prediction or guess.
  double tolerance() const;
  /// True if an algebraic error (negative: unknown) is small enough by the current estimate, prediction or guess.
  bool within(double error) const { return on() && error >= 0.0 && error <= target(); }
  /// True if the algebraic error is small enough and the estimate is reliable.
  bool met(double error) const { return sure_ && within(error); }
  bool sure() const { return sure_; }
  /// Estimates the discretisation error at a state with the given algebraic error. Collective.
  void estimate(const InterfaceState& state, double error);
  /// Pairs have changed: the estimate is out of date.
  void statusChanged() { sure_ = false; }
  /// Lowers the target by a factor of ten, for friction: its tangents are not symmetric, and the search turns directions of slip.
  void tighten() { share_ *= 0.1; }
  /// Criterion of a linear solve for the step from a state.
  /// \param lowest  smallest eigenvalue in earlier solves; 0: none
  /// \param first   the solve starts from zero
  /// \param last    probably the last solve: it estimates, if necessary, before it ends
  EnergyCriterion criterion(const InterfaceState& from, double lowest, bool first, bool last);

 private:
  /// Largest algebraic error, in the energy norm.
  double target() const;

  const InterfaceProblem& problem_;
  Estimate estimate_;
  std::optional<DiscretisationError> last_;
  Recovered recovered_;
  bool sure_ = false;
  double share_ = kShare, scale_ = 0.0, lowest_ = 1.0;
  int estimates_ = 0;
};

}  // namespace suture
