#include <suture/condensed/SemismoothNewton.hpp>
#include <suture/condensed/TrescaFixedPoint.hpp>
#include <suture/solver/AcceptSearch.hpp>
#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/FrictionSolves.hpp>

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
  const FrictionStates* friction = run.problem.friction();
  if (!friction) {
    ActiveSet::search(run, innerTolerance_);
    return;
  }
  const RigidBodyModel& rigid = run.problem.sets()->bodies().rigid();
  FrictionSolves solves(run, innerTolerance_);
  PairStates start;
  if (run.given)
    start = friction->statesOf(run.result.state.status);
  else
    run.result.state = friction->stateWith(PairStates(static_cast<std::size_t>(rigid.pairs())));
  const StateSearch::Result found =
      TrescaFixedPoint(rigid, friction->laws(), friction->sites(), solves, run.settings.maximumIterations).run(start);
  run.result.state.status = friction->statusOf(found.states);
  acceptSearch(run, found);
}

namespace {
const Registration<OuterSolver> registrationSemismoothNewton("Semismooth Newton", SemismoothNewton::schema(),
                                                             [](const Parameters& own) { return std::make_unique<SemismoothNewton>(own); });
}  // namespace

}  // namespace suture
