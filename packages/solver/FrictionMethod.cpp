#include <suture/base/Errors.hpp>
#include <suture/solver/AcceptSearch.hpp>
#include <suture/solver/FrictionMethod.hpp>
#include <suture/solver/FrictionSolves.hpp>

namespace suture {

void searchFriction(OuterSolver::Run& run, double innerTolerance) {
  const FrictionStates& friction = *run.problem.friction();
  const RigidBodyModel& rigid = run.problem.sets()->bodies().rigid();
  FrictionSolves solves(run, innerTolerance);
  PairStates start;
  if (run.given) start = friction.statesOf(run.result.state.status);
  if (!solves.couplesToNormal()) throw InternalError("a formulation whose bounds on friction must be given needs a method that finds them");
  StateSearch search(rigid, friction.laws(), friction.sites(), solves, run.settings.maximumIterations);
  if (start.empty()) start = search.start();
  if (!run.given) run.result.state = friction.stateWith(start);
  const StateSearch::Result found = search.run(start, run.given ? StateSearch::Start::Near : StateSearch::Start::Guess);
  run.result.state.status = friction.statusOf(found.states);
  acceptSearch(run, found);
}

}  // namespace suture
