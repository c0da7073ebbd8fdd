#include <suture/solver/AcceptSearch.hpp>

#include <sstream>

namespace suture {

void acceptSearch(OuterSolver::Run& run, const StateSearch::Result& found) {
  if (found.converged || !found.alternating.empty()) run.result.failure.clear();  // failure of an earlier attempt
  const bool restricts = run.problem.contact()->laws().restrictSliding();
  if (restricts && found.contraction >= 0.0) run.result.estimates["contraction"] = found.contraction;
  if (!found.converged) {
    run.result.slides = found.slides;
    run.result.multiple = found.multiple;
    run.result.unsettled = found.alternating;
    return;
  }
  run.solved = run.result.residual <= run.tolerance() || run.atFloor;
  if (run.atFloor && !run.done()) {
    std::ostringstream text;
    text.precision(2);
    text << std::scientific << "the residual stagnates at round-off: " << run.result.residual << ", above the tolerance of "
         << run.tolerance() << "; this scene cannot be solved more accurately in this precision";
    run.monitor.note(text.str());
  }
  if (restricts && found.contraction >= 1.0)
    run.monitor.note("friction: Coulomb fixed-point factor " + std::to_string(found.contraction) + " >= 1: the solution may not be unique");
}

}  // namespace suture
