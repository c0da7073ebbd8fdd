#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/Types.hpp>
#include <suture/quality/ErrorEstimate.hpp>
#include <suture/quality/PairResult.hpp>
#include <suture/quality/Verification.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// A rigid motion of a body that a solution does not determine: it changes no pair force, and no load drives it.
struct NeutralMotion {
  std::string body;
  std::string words;        ///< "turn about (3, 4), clockwise"
  bool loaded = false;      ///< forces act on the body: its place matters
  bool bothSenses = false;  ///< free forwards and backwards; else only away from pairs that touch
};

/// The answer of a run and the figures that summary.json reports.
struct Solution {
  bool converged = false;
  bool stopped = false;                ///< on request, before it converged
  std::string failure;                 ///< why not
  std::string undetermined;            ///< bodies that are free to move at the solution, where the scene does not allow that; else empty
  std::vector<NeutralMotion> neutral;  ///< see settleNeutralMotions()
  /// One vector for each subdomain of this rank, in the order of distribute(), beside its lift: node-major, Cartesian [length].
  std::vector<Vector> displacement;
  std::map<int, Matrix> ownStresses;  ///< Subdomain::stresses() of those of this rank with physics of their own, by place
  std::vector<PairResult> pairs;      ///< on rank 0: all, by id
  std::vector<PairResult> onAxis;     ///< on rank 0: see axisResults()

  std::string outerSolver;  ///< "" for a scene without unilateral contact
  int outerIterations = 0;
  int pcgTotal = 0;                                   ///< PCG steps of the outer iterations, without the auxiliary ones
  double residual = 0.0;                              ///< at the end, in the stopping norm
  double energyError = -1.0;                          ///< algebraic error in the energy norm, estimated; negative: not known
  std::optional<DiscretisationError> discretisation;  ///< estimated, if the scene asks for it
  AuxiliaryRow auxiliary;                             ///< all pairs closed, or the linear problem itself
  int coarseSize = 0;                                 ///< dimension of the preconditioner's coarse problem
  double setupSeconds = 0.0;                          ///< that the preconditioner took on this rank before its first use
  double bytesRead = 0.0;                   ///< bytes of this rank's memory that one conjugate gradient iteration reads, as far as known
  std::map<std::string, int> chosenSchur;   ///< local problems, by how their Schur complement is kept where that was chosen automatically
  double energy = 0.0;                      ///< total potential energy a(u,u)/2 - L(u)
  Verification verification;                ///< and the balance of forces; without checks before verify()
  std::map<std::string, double> errors;     ///< against the scene's exact solution, where it has one: see exactErrors()
  std::map<std::string, double> estimates;  ///< figures of the outer solver: "mu", "contraction bound", "radius", "relaxation", ...
};

}  // namespace suture
