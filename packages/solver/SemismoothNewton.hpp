#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Semismooth Newton on the condensed gradient: (S_0 + S_KON'(status at U)) dU = -grad J(U). Three to seven steps from the auxiliary
/// solution, whatever the mesh. Full steps; halved only while both residual and energy grow (energy differences below rounding mean
/// nothing). Where the tangent is singular (a body hangs loose with the pairs now closed) S takes its place for that step: a majorant, so
/// the energy still falls.
class SemismoothNewton : public OuterSolver {
 public:
  static Schema schema();
  explicit SemismoothNewton(const Parameters& own);

 protected:
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings&) const override { return innerTolerance_; }

 private:
  double innerTolerance_;
};

}  // namespace suture
