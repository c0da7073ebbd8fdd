#pragma once
#include <suture/search/LinearContactSolver.hpp>
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Linear solver of StateSearch for given states of frictional contact on the interface: conjugate gradients for symmetric tangents
/// (stick, Tresca), GMRES if tangential forces depend on normal ones (Coulomb), both with the symmetric preconditioner of the space.
/// Tolerances are relative to the energy norm of the solution. Collective.
class FrictionSolves : public LinearContactSolver {
 public:
  /// \param inner  tolerance of the loosest solves
  FrictionSolves(OuterSolver::Run& run, double inner);

  double loosest() const override { return inner_; }
  bool couplesToNormal() const override { return friction_.couplesToNormal(); }
  double tightest() const override { return run_.settings.tolerance; }
  ContactAnswer solve(const PairStates& states, double tolerance) override;
  void move(const Vector& motion) override { sets_.move(run_.result.state, motion); }
  Vector motion() const override { return run_.result.state.rigid; }
  bool goesOn() override { return !run_.stopRequested(); }

 private:
  void precondition(const Teuchos::RCP<InterfaceOperator>& matrix);
  bool linear(InterfaceState& state, double tolerance, InnerResult& cost, int& applications);
  double energyNorm(const InterfaceState& state) const;
  double norm(const PairValues& values, const InterfaceState& state, double& largest);
  ContactAnswer answerOf(const PairValues& values, const PairStates& states, double resolution) const;

  OuterSolver::Run& run_;
  const FrictionStates& friction_;
  const ContactSets& sets_;
  const double inner_;
  PairStates last_;
  Vector ofParts_;                          // twice the largest energies of the parts
  double reference_ = 0.0, largest_ = 0.0;  // energy norms: of the last solution, and the largest one
  double nothing_ = 0.0;  // accuracy of the forces of a last solution with negligible energy, relative to the forces of the path
};

}  // namespace suture
