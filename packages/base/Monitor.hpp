#pragma once
#include <string>

namespace suture {

/// Report of an outer solver about one of its iterations: a row of the console's table and of history.csv.
struct OuterRow {
  int iteration = 0;
  int pcg = 0;                ///< operator applications of the inner solver in this iteration, failed steps included
  double condition = 0.0;     ///< Lanczos estimate of the preconditioned operator; 0 when there was no inner iteration
  double residual = 0.0;      ///< in the stopping norm, relative to the residual of the lifted start
  double euclidean = 0.0;     ///< the Euclidean norm beside it, relative too; decides nothing
  int active = 0;             ///< closed pairs
  int changed = 0;            ///< pairs whose status changed in this iteration
  double energy = 0.0;        ///< total potential energy
  double step = 1.0;          ///< length of the step taken (relaxation, line search)
  double seconds = 0.0;       ///< since the outer solver began
  int loadStep = 0;           ///< the load step, from 1 on; 0 in a scene without
  double energyError = -1.0;  ///< algebraic error in the energy norm, estimated [force x length]^(1/2); negative: not known
};

/// The auxiliary (all pairs closed) or purely linear problem.
struct AuxiliaryRow {
  int pcg = 0;
  double condition = 0.0;
  double tolerance = 0.0;          ///< asked for
  double residual = 0.0;           ///< reached, in the stopping norm
  bool contact = true;             ///< false: the scene is linear and this is its solution
  double energyError = -1.0;       ///< as in OuterRow, of the problem with all pairs closed
  double iterationSeconds = -1.0;  ///< seconds of one iteration; negative: there was none
};

/// Observer of a run: solvers speak to it, reports listen. Called on every rank with the same numbers, so that a listener may
/// communicate. Does nothing by itself.
class Monitor {
 public:
  virtual ~Monitor() = default;
  virtual void auxiliary(const AuxiliaryRow&) {}
  virtual void outer(const OuterRow&) {}
  /// A sentence for the user: a choice made automatically, an estimate, a refusal's reason.
  virtual void note(const std::string&) {}
  /// One inner (PCG) iteration; only for those who ask for it (--verbose).
  virtual void inner(int /*iteration*/, double /*relativeResidual*/) {}
  virtual bool wantsInner() const { return false; }
  /// True if the user asked this process to stop at the next opportunity; outer solvers ask after every iteration, on all ranks.
  virtual bool stopRequested() const { return false; }
};

}  // namespace suture
