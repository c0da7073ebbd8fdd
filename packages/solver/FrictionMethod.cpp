#include <suture/base/Errors.hpp>
#include <suture/solver/FrictionMethod.hpp>
#include <suture/solver/FrictionSolves.hpp>

#include <sstream>

namespace suture {

void searchFriction(OuterSolver::Run& run, double innerTolerance) {
  const FrictionStates& friction = *run.problem.friction();
  const RigidContact& rigid = run.problem.sets()->bodies().rigid();
  FrictionSolves solves(run, innerTolerance);
  PairStates start;
  if (run.given) start = friction.statesOf(run.result.state.status);
  if (!solves.couplesToNormal()) throw InternalError("a formulation whose bounds on friction must be given needs a method that finds them");
  StateSearch search(rigid, friction.laws(), friction.sites(), solves, run.settings.maximumIterations);
  if (start.empty()) start = search.start();
  if (!run.given) run.result.state = friction.stateWith(start);
  acceptSearch(run, search.run(start));
}

void acceptSearch(OuterSolver::Run& run, const StateSearch::Result& found) {
  run.result.state.status = run.problem.friction()->statusOf(found.states);
  if (found.converged || !found.alternating.empty()) run.result.failure.clear();  // failure of an earlier attempt
  if (found.contraction >= 0.0) run.result.estimates["contraction"] = found.contraction;
  if (found.converged) {
    run.solved = run.result.residual <= run.settings.tolerance || run.atFloor;
    if (run.atFloor) {
      std::ostringstream text;
      text.precision(2);
      text << std::scientific << "the residual stagnates at round-off: " << run.result.residual << ", above the tolerance of "
           << run.settings.tolerance << "; this scene cannot be solved more accurately in this precision";
      run.monitor.note(text.str());
    }
    if (found.contraction >= 1.0)
      run.monitor.note("friction: Coulomb fixed-point factor " + std::to_string(found.contraction) +
                       " >= 1: the solution may not be unique");
    return;
  }
  run.result.slides = found.slides;
  run.result.multiple = found.multiple;
  run.result.unsettled = found.alternating;
}

}  // namespace suture
