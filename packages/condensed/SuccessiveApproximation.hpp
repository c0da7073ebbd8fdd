#pragma once
#include <suture/solver/OuterSolver.hpp>

#include <string>

namespace suture {

/// The paper's successive approximations (18)/(32): S_0 U^k = F - S_KON(U^(k-1)), written as a correction and relaxed:
///     U^k = U^(k-1) + theta S_0^-1 (F - S_0 U^(k-1) - S_KON(U^(k-1))).
/// They contract if and only if the spectral radius of S_0^-1 S_KON' at the solution is below 1. At the start mu = lambda_max(S_0^-1 S^0)
/// and the bound of (41), 2 lambda^2 P_c with |R_j u|_a*j <= lambda ||u||_S0, are estimated; at the end the spectral radius at the final
/// contact state. Relaxation: None (theta = 1), Automatic (theta = 2 / (2 + 1.1 mu), halved when the energy rises), or a value.
class SuccessiveApproximation : public OuterSolver {
 public:
  static Schema schema();
  explicit SuccessiveApproximation(const Parameters& own);
  bool solves(const Formulation& formulation) const override { return formulation.hidesContact(); }

 protected:
  /// \throws NumericalError  if S_0 is singular, with the reason
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings& settings) const override { return settings.tolerance; }

 private:
  double innerTolerance_;
  std::string relaxation_;
};

}  // namespace suture
