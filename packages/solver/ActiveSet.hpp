#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Active set on the interface for Contact On The Interface: StateSearch with InterfaceSolves. Starts from rigid bodies
/// on pads, without a linear solve, or with all pairs closed (Outer Solver/Start).
///
/// Linear solves use the inner tolerance, tightened with the distance from the contact laws, until the set no longer changes, then the
/// final tolerance; conjugate gradients are resumed as long as the set is unchanged.
class ActiveSet : public OuterSolver {
 public:
  static Schema schema();
  explicit ActiveSet(const Parameters& own);
  bool solves(const Formulation& formulation) const override { return !formulation.hidesContact(); }
  bool knowsFriction() const override { return true; }
  /// StateSearch from run.result.state, or with friction from its own start.
  /// \param innerTolerance  of linear solves until the set no longer changes
  static void search(Run& run, double innerTolerance);

 protected:
  bool worksBySets() const override { return true; }
  bool wantsAuxiliary() const override { return false; }
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings& settings) const override;

 private:
  double innerTolerance_;
};

}  // namespace suture
