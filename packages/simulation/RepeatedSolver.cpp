#include <suture/simulation/RepeatedSolver.hpp>

namespace suture {

Solution RepeatedSolver::solve(const Solution* before, bool isPrepared, const std::vector<Vector>* displacement) {
  const RunContext& run = parts_.run;
  if (!isPrepared && method_ && method_->reloads()) {
    method_->reload(run.timers());
  } else if (!isPrepared) {
    method_.reset();
    method_ = preparedMethod(parts_, nullptr, true);
  }
  std::optional<Start> start = before ? startOf(run.comm(), *before) : start_;
  if (start && displacement) start->displacement = *displacement;
  if (start && parts_.path) start->carried = parts_.path->carried();
  return method_->solve(run.monitor(), run.timers(), start && method_->takesStart() ? &*start : nullptr);
}

}  // namespace suture
