#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/solver/ErrorEstimate.hpp>
#include <suture/solver/InnerSolver.hpp>

#include <functional>
#include <optional>

namespace suture {

/// `Outer Solver/Tolerance` = Automatic: digits that the mesh cannot hold are not computed. Iterations end where the algebraic error is at
/// most a tenth of the estimated discretisation error, both in the energy norm: together they are then at most 0.5 % more than the latter.
/// (With pairs settled, an iterate solves the contact problem under loads that differ by its residual: the error is that of a linear
/// problem.) The first estimate is made when the algebraic error has fallen to 2 % of that of the start. Algebraic error makes it too
/// large, and so may another contact status; it is made again where the iterations would end, unless the problem is linear and the
/// algebraic error was below 0.3 of the first estimate, which is then at most about 5 % too large, where errors add by squares.
class AutomaticTolerance {
 public:
  /// Of the free unknowns' values of this rank's subdomains. Collective.
  using Estimate = std::function<DiscretisationError(const std::vector<Vector>& freeValues)>;

  /// \param estimate  null: there is no such tolerance, and nothing below ever ends an iteration. `problem` must outlive this.
  AutomaticTolerance(const InterfaceProblem& problem, Estimate estimate) : problem_(problem), estimate_(std::move(estimate)) {}

  bool on() const { return estimate_ != nullptr; }
  bool known() const { return last_.has_value(); }
  const std::optional<DiscretisationError>& last() const { return last_; }
  int estimates() const { return estimates_; }
  double target() const { return share_ * last_->energyNorm; }
  /// Whether an algebraic error (negative: not known) is small enough.
  bool met(double error) const { return on() && known() && error >= 0.0 && error <= target(); }
  /// Estimates at a state. Collective.
  void estimate(const InterfaceState& state);
  /// For a method that turns in a circle: ten times less is asked for from now on.
  void tighten() { share_ *= 0.1; }
  /// For a linear solve whose unknown is the step from a state.
  /// \param lowest  smallest eigenvalue that earlier solves found, 0: none
  /// \param last    nothing comes after this solve: it estimates again before it ends
  EnergyCriterion criterion(const InterfaceState& from, double lowest, bool last = false);

 private:
  const InterfaceProblem& problem_;
  Estimate estimate_;
  std::optional<DiscretisationError> last_;
  double share_ = 0.1;
  int estimates_ = 0;
};

}  // namespace suture
