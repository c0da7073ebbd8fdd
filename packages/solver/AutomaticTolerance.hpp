#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/solver/InnerSolver.hpp>

#include <functional>

namespace suture {

/// `Outer Solver/Tolerance` = Automatic: digits that the mesh cannot hold are not computed. Iterations end where the algebraic error is at
/// most a tenth of the estimated discretisation error, both in the energy norm: together they are then at most 0.5 % more than the latter.
/// Algebraic error makes the estimate too large. So the first is made when the algebraic error has fallen to 2 % of that of the start, and
/// it stands if the algebraic error is below 0.3 of it (the estimate then being at most about 5 % too large, where errors add by squares);
/// if not, it is made again where the iterations would end.
class AutomaticTolerance {
 public:
  /// Energy norm of the discretisation error, of the free unknowns' values of this rank's subdomains. Collective.
  using Estimate = std::function<double(const std::vector<Vector>& freeValues)>;

  /// \param estimate  null: there is no such tolerance, and nothing below ever ends an iteration. `problem` must outlive this.
  AutomaticTolerance(const InterfaceProblem& problem, Estimate estimate) : problem_(problem), estimate_(std::move(estimate)) {}

  bool on() const { return estimate_ != nullptr; }
  bool known() const { return discretisation_ >= 0.0; }
  double discretisation() const { return discretisation_; }  ///< last estimate
  int estimates() const { return estimates_; }
  double target() const { return share_ * discretisation_; }
  /// Whether an algebraic error (negative: not known) is small enough.
  bool met(double error) const { return on() && known() && error >= 0.0 && error <= target(); }
  /// Estimates at a state, unless an estimate stands. \param error  algebraic error there; negative: not known. Collective.
  void estimate(const InterfaceState& state, double error);
  /// For a method that turns in a circle: ten times less is asked for from now on.
  void tighten() { share_ *= 0.1; }
  /// For a linear solve whose unknown is the step from a state.
  /// \param lowest  smallest eigenvalue that earlier solves found, 0: none
  /// \param last    nothing comes after this solve: it estimates again before it ends
  EnergyCriterion criterion(const InterfaceState& from, double lowest, bool last = false);

 private:
  const InterfaceProblem& problem_;
  Estimate estimate_;
  double discretisation_ = -1.0, share_ = 0.1;
  bool stands_ = false;
  int estimates_ = 0;
};

}  // namespace suture
