#pragma once
#include <string>

namespace suture {

/// Report of one iteration of an outer solver: a row of the console's table and of history.csv.
struct OuterRow {
  int iteration = 0;
  int pcg = 0;                ///< operator applications of the inner solver in this iteration, failed steps included
  double condition = 0.0;     ///< Lanczos estimate of the preconditioned operator; 0 when there was no inner iteration
  double residual = 0.0;      ///< in the stopping norm, relative to the residual of the lifted start
  double euclidean = 0.0;     ///< Euclidean norm of the residual, relative as well; for information only
  int active = 0;             ///< closed pairs
  int changed = 0;            ///< pairs whose status changed in this iteration
  double energy = 0.0;        ///< total potential energy
  double step = 1.0;          ///< length of the step taken (relaxation, line search)
  double seconds = 0.0;       ///< since the outer solver began
  int loadStep = 0;           ///< load step, from 1 on; 0 in a scene without load steps
  double energyError = -1.0;  ///< algebraic error in the energy norm, estimated [force x length]^(1/2); negative: not known
};

/// The auxiliary (all pairs closed) or purely linear problem.
struct AuxiliaryRow {
  int pcg = 0;
  double condition = 0.0;
  double tolerance = 0.0;          ///< requested
  double residual = 0.0;           ///< reached, in the stopping norm
  bool contact = true;             ///< false: the scene is linear and this is its solution
  double energyError = -1.0;       ///< as in OuterRow, of the problem with all pairs closed
  double iterationSeconds = -1.0;  ///< seconds of one iteration; negative: there was none
};

/// Observer of a run: solvers call it, reports implement it. Called on every rank with the same numbers, so an observer may communicate.
/// The base class does nothing.
class Monitor {
 public:
  virtual ~Monitor() = default;
  virtual void auxiliary(const AuxiliaryRow&) {}
  virtual void outer(const OuterRow&) {}
  /// A sentence for the user: a choice made automatically, an estimate, the reason of a refusal.
  virtual void note(const std::string&) {}
  /// One inner (PCG) iteration; called only if wantsInner() (--verbose).
  virtual void inner(int /*iteration*/, double /*relativeResidual*/) {}
  virtual bool wantsInner() const { return false; }
  /// True if the user has requested a stop at the next opportunity; outer solvers check after every iteration, on all ranks.
  virtual bool stopRequested() const { return false; }
};

}  // namespace suture
