#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Chord iteration U += S^-1 (F - S_0 U - S_KON(U)) with S of all pairs closed. Each step minimises a majorant of the energy, so the energy
/// decreases, and the iteration converges for every coercive problem. Accelerated by Anderson's method over the last corrections (combined
/// in the S inner product); an accelerated step that raises the energy is replaced by the plain one.
class Chord : public OuterSolver {
 public:
  static Schema schema();
  explicit Chord(const Parameters& own);
  bool solves(const Formulation& formulation) const override { return formulation.hidesContact(); }

 protected:
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings&) const override { return innerTolerance_; }

 private:
  double innerTolerance_;
  int depth_;
};

}  // namespace suture
