#include <suture/condensed/SemismoothNewton.hpp>
#include <suture/condensed/TrescaFixedPoint.hpp>
#include <suture/solver/AcceptSearch.hpp>
#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/InterfaceSolves.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

Schema SemismoothNewton::schema() {
  Schema schema("Newton's method on the condensed contact problem.");
  schema.real(
      "Inner Tolerance", 1e-2,
      "Tolerance of linear solves until the set of closed pairs no longer changes, relative to the energy norm of the solution; for "
      "the auxiliary problem, relative to its right-hand side.",
      {0.0, 1.0, true, true, {}});
  return schema;
}

SemismoothNewton::SemismoothNewton(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")) {}

double SemismoothNewton::auxiliaryTolerance(const OuterSettings& settings) const { return std::max(innerTolerance_, settings.tolerance); }

void SemismoothNewton::doSolve(Run& run) const {
  if (!run.problem.contact() || !run.problem.contact()->laws().restrictSliding()) {
    ActiveSet::search(run, innerTolerance_);
    return;
  }
  const ContactProblem& contact = *run.problem.contact();
  const RigidBodyModel& rigid = contact.bodies().rigid();
  InterfaceSolves solves(run, innerTolerance_);
  PairStates start;
  if (run.given)
    start = contact.statesOf(run.result.state.status);
  else
    run.result.state = contact.stateWith(PairStates(static_cast<std::size_t>(rigid.pairs())));
  const StateSearch::Result found =
      TrescaFixedPoint(rigid, contact.laws(), contact.sites(), solves, run.settings.maximumIterations).run(start);
  run.result.state.status = contact.statusOf(found.states);
  acceptSearch(run, found);
}

namespace {
const Registration<OuterSolver> registrationSemismoothNewton("Semismooth Newton", SemismoothNewton::schema(),
                                                             [](const Parameters& own) { return std::make_unique<SemismoothNewton>(own); });
}  // namespace

}  // namespace suture
