#pragma once
#include <suture/search/LinearContactSolver.hpp>
#include <suture/solver/ClusterScales.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <algorithm>

namespace suture {

/// Linear solver of StateSearch for contact on the interface: conjugate gradients if the tangent is symmetric (no friction, stick, Tresca),
/// GMRES if tangential forces depend on normal ones (Coulomb), both with the symmetric preconditioner of the space. Residuals and unknowns
/// are scaled by ClusterScales. Collective.
class InterfaceSolves : public LinearContactSolver {
 public:
  /// \param inner  tolerance of the loosest solves
  InterfaceSolves(OuterSolver::Run& run, double inner);

  /// Evaluates the given start of a run; run.done() is true if it is the solution.
  void evaluateStart();

  double loosest() const override { return std::max(inner_, tightest()); }
  double tightest() const override { return run_.tolerance(); }
  bool couplesToNormal() const override { return contact_.couplesToNormal(); }
  ContactAnswer solve(const PairStates& states, double tolerance) override;
  void move(const Vector& motion) override { suture::move(run_.result.state, motion); }
  Vector motion() const override { return run_.result.state.rigid; }
  bool goesOn() override { return !run_.done() && !run_.stopRequested(); }

 private:
  void precondition(const InterfaceState& state, const Teuchos::RCP<InterfaceOperator>& matrix);
  double norm(const PairValues& values, const InterfaceState& state);
  double middle() const;
  PairResolution finalResolution() const;
  PairResolution resolution(double tolerance) const;
  void chooseOrigin(const InterfaceState& from, InterfaceState& state, int& applications);
  bool oneSolve(InterfaceState& state, bool goOn, double requested, InnerResult& cost, int& applications);
  bool solveLinear(InterfaceState& state, bool goOn, double tolerance, const EnergyCriterion& criterion, InnerResult& cost,
                   int& applications);
  bool canGoOn() const { return !matrix_.is_null() && matrix_->symmetric() && run_.inner.canGoOn(); }
  ContactAnswer failed(std::string reason);

  OuterSolver::Run& run_;
  const ContactProblem& contact_;
  const double inner_;
  MultiVectorPtr step_;
  PairStates last_;                 // states of the last solve; empty if it cannot be resumed
  ContactStates preconditioned_;    // states for which the preconditioner was made
  bool hasPreconditioner_ = false;  // the same on all ranks, including those without a local problem
  Teuchos::RCP<InterfaceOperator> matrix_;
  ClusterScales scales_;
  double whole_ = 0.0;     // last global residual norm; single bodies may have more than their share
  double sharper_ = 1.0;   // factor on tolerances, for the residuals of single bodies
  InterfaceState start_;   // state and status of the first solve, until the second one
  bool deformed_ = false;  // the state is the answer of a solve, so its energy is a valid scale
};

}  // namespace suture
