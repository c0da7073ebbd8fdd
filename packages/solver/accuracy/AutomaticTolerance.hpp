#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/quality/ErrorEstimate.hpp>
#include <suture/solver/InnerSolver.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace suture {

/// `Outer Solver/Tolerance` = Automatic: digits that the mesh cannot hold are not computed. Iterations end where the algebraic error is at
/// most a tenth of the estimated discretisation error, both in the energy norm: together they are then at most 0.5 % more than the latter.
/// (With pairs settled, an iterate solves the contact problem under loads that differ by its residual: the error is that of a linear
/// problem.)
///
/// An estimate costs as much as many iterations. Hence none is made before the iterations might end: where the algebraic error is a tenth
/// of the discretisation error that is to be expected of a mesh of so many nodes. If the estimate is not smaller, the iterations do end
/// there, and what was recovered for it is the answer. Else they go on, to a tenth of the estimate; that is made again only if the
/// algebraic error then was more than half of it (and may have made it more than 13 % too large, as errors add by squares), or pairs have
/// changed since.
class AutomaticTolerance {
 public:
  struct Estimate {
    std::function<DiscretisationError(const std::vector<Vector>& freeValues)> of;  ///< error of this rank's subdomains; collective
    double expected = 0.0;                                                         ///< guess of it, relative to the norm of the solution
  };
  using Recovered = std::shared_ptr<const InterfaceProblem::Recovered>;

  /// \param estimate  empty: there is no such tolerance, and nothing below ever ends an iteration. `problem` must outlive this.
  AutomaticTolerance(const InterfaceProblem& problem, Estimate estimate) : problem_(problem), estimate_(std::move(estimate)) {}

  bool on() const { return estimate_.of != nullptr; }
  const std::optional<DiscretisationError>& last() const { return last_; }
  int estimates() const { return estimates_; }
  /// Recovered solution of the estimate at the end of the last solve, given out once; else null.
  Recovered takeRecovered() { return std::exchange(recovered_, nullptr); }

  /// The norm of the solution, roughly: better when the first solve has told it.
  void startsFrom(double norm) { scale_ = norm; }
  /// True if an algebraic error (negative: not known) may be small enough, as far as is known.
  bool within(double error) const { return on() && error >= 0.0 && error <= target(); }
  /// True if the algebraic error is small enough and the estimate is good enough to say so.
  bool met(double error) const { return sure_ && within(error); }
  bool sure() const { return sure_; }
  /// Estimates at a state with an algebraic error. Collective.
  void estimate(const InterfaceState& state, double error);
  /// Pairs have changed: the estimate is not that of the state any more.
  void statusChanged() { sure_ = false; }
  /// For a method that turns in a circle: ten times less is asked for from now on.
  void tighten() { share_ *= 0.1; }
  /// For a linear solve whose unknown is the step from a state.
  /// \param lowest  smallest eigenvalue that earlier solves found, 0: none
  /// \param first   the solve starts from nothing
  /// \param last    nothing is expected to come after this solve: it estimates, if need be, before it ends
  EnergyCriterion criterion(const InterfaceState& from, double lowest, bool first, bool last);

 private:
  double target() const { return share_ * (last_ ? last_->energyNorm : estimate_.expected * scale_); }

  const InterfaceProblem& problem_;
  Estimate estimate_;
  std::optional<DiscretisationError> last_;
  Recovered recovered_;
  bool sure_ = false;
  double share_ = 0.1, scale_ = 0.0;
  int estimates_ = 0;
};

}  // namespace suture
