#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/quality/ErrorEstimate.hpp>

#include <map>
#include <optional>
#include <string>

namespace suture {

/// Figures of a solver about its own work, the same for the result of an outer solver and for the answer of a run.
struct OuterFigures {
  bool converged = false;
  bool stopped = false;       ///< on request, before it converged
  std::string failure;        ///< why not
  int iterations = 0;         ///< outer iterations
  int pcgTotal = 0;           ///< PCG steps of the outer iterations, failed ones included, without the auxiliary ones
  int otherApplications = 0;  ///< applications among them that no step of conjugate gradients made: residuals, gaps closed
  double residual = 0.0;      ///< at the end, in the stopping norm
  double energyError = -1.0;  ///< algebraic error at the end in the energy norm, estimated; negative: not known
  std::optional<DiscretisationError> discretisation;  ///< estimated, if the scene or an automatic tolerance asks for it
  AuxiliaryRow auxiliary;                             ///< all pairs closed, or the linear problem itself
  int coarseSize = 0;                                 ///< dimension of the preconditioner's coarse problem
  double lowestEigenvalue = -1.0;                     ///< lowest Ritz value of M^-1 S in all linear solves; negative: none was made
  double setupSeconds = 0.0;                          ///< time that the preconditioner took on this rank before its first use
  double bytesRead = 0.0;                   ///< bytes of this rank's memory that one conjugate gradient iteration reads, as far as known
  std::map<std::string, int> chosenSchur;   ///< local problems over all ranks, by how Automatic keeps their Schur complements
  std::map<std::string, double> estimates;  ///< figures of the method: "mu", "contraction bound", "radius", "relaxation", ...
};

}  // namespace suture
