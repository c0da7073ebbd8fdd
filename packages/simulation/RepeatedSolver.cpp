#include <suture/simulation/RepeatedSolver.hpp>
#include <suture/simulation/Restart.hpp>

namespace suture {

/// Largest forces on each body so far, and those of its initial stress; empty: unknown.
std::vector<BodyForces> RepeatedSolver::carried() const {
  std::vector<BodyForces> all = parts_.path->carried();
  if (all.empty()) return inSitu_;
  for (std::size_t b = 0; b < inSitu_.size(); ++b) all[b].take(inSitu_[b]);
  return all;
}

Solution RepeatedSolver::solve(const Solution* before, bool isPrepared, const std::vector<Vector>* displacement, double) {
  const RunContext& run = parts_.run;
  if (!isPrepared && method_ && method_->reloads()) {
    method_->reload(run.timers());
  } else if (!isPrepared) {
    method_.reset();
    method_ = preparedMethod(parts_, nullptr, true);
  }
  std::optional<Start> start = before ? startOf(run.comm(), *before) : start_;
  if (start && displacement) start->displacement = *displacement;
  if (start && parts_.path) start->carried = carried();
  return method_->solve(run.monitor(), run.timers(), start && method_->takesStart() ? &*start : nullptr);
}

Solution RepeatedSolver::goOnFrom(const PathState& state) { return lastSolution(parts_, *start_, state); }

}  // namespace suture
