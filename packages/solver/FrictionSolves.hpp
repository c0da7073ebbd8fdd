#pragma once
#include <suture/contact/FrictionSearch.hpp>
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// The linear problems of given states of contact with friction on the interface: what FrictionSearch asks of a formulation. Conjugate
/// gradients where the tangent is symmetric (stick, Tresca), GMRES where normal forces drag (Coulomb), both with the symmetric
/// preconditioner of the space. Tolerances are relative to the energy norm of the solution. Collective.
class FrictionSolves : public FrictionOracle {
 public:
  /// \param inner  tolerance of the loosest solves
  FrictionSolves(OuterSolver::Run& run, double inner);

  double loosest() const override { return inner_; }
  bool drags() const override { return friction_.drags(); }
  double tightest() const override { return run_.settings.tolerance; }
  FrictionAnswer solve(const PairStates& states, double tolerance) override;
  bool goesOn() override { return !run_.stopRequested(); }

 private:
  void precondition(const Teuchos::RCP<InterfaceOperator>& matrix);
  bool linear(InterfaceState& state, double tolerance, InnerResult& cost, int& applications);
  double energyNorm(const InterfaceState& state) const;
  double norm(const PairValues& values, const InterfaceState& state, double& largest);
  FrictionAnswer answerOf(const PairValues& values, const PairStates& states, double resolution) const;

  OuterSolver::Run& run_;
  const FrictionStates& friction_;
  const ContactSets& sets_;
  const double inner_;
  PairStates last_;
  Vector ofParts_;                          // largest energies of the parts, twice
  double reference_ = 0.0, largest_ = 0.0;  // energy norms: of the last solution, the largest of all
  double nothing_ = 0.0;                    // part of the path's forces that the last solution's are known to, if it has no more
};

}  // namespace suture
