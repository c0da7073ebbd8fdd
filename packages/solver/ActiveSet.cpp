#include <suture/base/Errors.hpp>
#include <suture/search/StateSearch.hpp>
#include <suture/solver/AcceptSearch.hpp>
#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/InterfaceSolves.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

Schema ActiveSet::schema() {
  Schema schema("Active set on the interface (Contact On The Interface).");
  schema.real("Inner Tolerance", 1e-2,
              "Tolerance of linear solves until the set of closed pairs no longer changes, relative to the energy norm of the solution.",
              {0.0, 1.0, true, true, {}});
  return schema;
}

ActiveSet::ActiveSet(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")) {}

double ActiveSet::auxiliaryTolerance(const OuterSettings& settings) const { return std::max(innerTolerance_, settings.tolerance); }

void ActiveSet::doSolve(Run& run) const { search(run, innerTolerance_); }

void ActiveSet::search(Run& run, double innerTolerance) {
  if (!run.problem.contact()) throw InternalError("a method by pair states needs a formulation that offers them");
  const ContactProblem& contact = *run.problem.contact();
  const RigidBodyModel& rigid = contact.bodies().rigid();
  const bool restricts = contact.laws().restrictSliding();
  InterfaceSolves solves(run, innerTolerance);
  if (!solves.couplesToNormal() && restricts)
    throw InternalError("a formulation whose bounds on friction must be given needs a method that finds them");
  if (run.given && !restricts) {
    solves.evaluateStart();
    if (run.done()) return;
  }
  StateSearch search(rigid, contact.laws(), contact.sites(), solves, run.settings.maximumIterations);
  PairStates start = contact.statesOf(run.result.state.status);
  if (restricts && !run.given && run.settings.rigidStart) {
    start = search.start();
    run.result.state = contact.stateWith(start);
  } else if (!restricts && rigid.loosens(closedSet(start))) {
    start = contact.statesOf(contact.padState().status);
  }
  const bool isNear = restricts && run.given;
  const StateSearch::Result found = search.run(std::move(start), isNear ? StateSearch::Start::Near : StateSearch::Start::Guess);
  run.result.state.status = contact.statusOf(found.states);
  acceptSearch(run, found);
}

}  // namespace suture
