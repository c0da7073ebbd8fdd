#include <suture/base/Errors.hpp>
#include <suture/search/StateSearch.hpp>
#include <suture/solver/AcceptSearch.hpp>
#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/FrictionMethod.hpp>
#include <suture/solver/SetSolves.hpp>

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

void ActiveSet::doSolve(Run& run) const {
  if (run.problem.friction())
    searchFriction(run, innerTolerance_);
  else
    search(run, innerTolerance_);
}

void ActiveSet::search(Run& run, double innerTolerance) {
  if (!run.problem.sets()) throw InternalError("a method by sets needs a formulation whose contact states are sets of closed pairs");
  const ContactSets& sets = *run.problem.sets();
  SetSolves solves(run, innerTolerance);
  if (run.given) {
    solves.evaluateStart();
    if (run.done()) return;
  }
  ClosedSet start = sets.closedSet(run.result.state.status);
  if (sets.bodies().rigid().loosens(start)) start = sets.closedSet(sets.padState().status);
  StateSearch search(sets.bodies().rigid(), solves, run.settings.maximumIterations);
  const StateSearch::Result found = search.run(statesOf(start));
  run.result.state.status = sets.statusOf(closedSet(found.states));
  acceptSearch(run, found);
}

}  // namespace suture
