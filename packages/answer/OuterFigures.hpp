#pragma once
#include <suture/answer/error/ErrorEstimate.hpp>
#include <suture/base/Monitor.hpp>

#include <map>
#include <optional>
#include <string>

namespace suture {

/// Solver statistics, common to the result of an outer solver and the solution of a run.
struct OuterFigures {
  bool converged = false;
  bool stopped = false;       ///< stopped on request before convergence
  std::string failure;        ///< why it did not converge
  int iterations = 0;         ///< outer iterations
  int pcgTotal = 0;           ///< PCG steps of the outer iterations, including failed ones, without the auxiliary problem
  int otherApplications = 0;  ///< operator applications among them outside conjugate gradients: residuals, closing gaps
  double residual = 0.0;      ///< final residual in the stopping norm
  double energyError = -1.0;  ///< estimated final algebraic error in the energy norm; negative: unknown
  std::optional<DiscretisationError> discretisation;  ///< estimated, if the scene or an automatic tolerance requires it
  AuxiliaryRow auxiliary;                             ///< problem with all pairs closed, or the linear problem itself
  int coarseSize = 0;                                 ///< dimension of the preconditioner's coarse problem
  double lowestEigenvalue = -1.0;                     ///< lowest Ritz value of M^-1 S in all linear solves; negative: none
  double setupSeconds = 0.0;                          ///< setup time of the preconditioner on this rank before its first use
  double bytesRead = 0.0;                             ///< known bytes of this rank's memory read per conjugate gradient iteration
  std::map<std::string, int> chosenSchur;   ///< number of local problems over all ranks, by the Schur complement chosen by Automatic
  std::map<std::string, double> estimates;  ///< figures of the method: "mu", "contraction bound", "radius", "relaxation", ...
};

}  // namespace suture
