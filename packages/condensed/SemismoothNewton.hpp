#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Semismooth Newton on the condensed gradient: (S_0 + S_KON'(status at U)) dU = -grad J(U). A set of closed pairs defines a tangent;
/// StateSearch finds the next set and makes the method globally convergent. Starts from rigid bodies on pads, or from the auxiliary
/// solution (Outer Solver/Start = Bilateral), where the groups' response to the trace gives the first set; from there it takes three to
/// seven steps.
class SemismoothNewton : public OuterSolver {
 public:
  static Schema schema();
  explicit SemismoothNewton(const Parameters& own);
  bool solves(const Formulation& formulation) const override { return formulation.hidesContact(); }
  bool knowsFriction() const override { return true; }

 protected:
  bool worksBySets() const override { return true; }
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings& settings) const override;

 private:
  double innerTolerance_;
};

}  // namespace suture
