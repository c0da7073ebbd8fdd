#include <suture/contact/ContactSearch.hpp>
#include <suture/contact/StateSearch.hpp>
#include <suture/solver/FrictionMethod.hpp>
#include <suture/solver/FrictionSolves.hpp>
#include <suture/solver/SetSolves.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

namespace {

constexpr int kFrictionless = 2;  // maximum number of solves of the frictionless start, which is a guess

/// True if rigid bodies have a unique equilibrium without friction.
bool holdsWithoutFriction(const RigidContact& rigid) {
  if (rigid.loose(ClosedSet(static_cast<std::size_t>(rigid.pairs()), 1)).cols() > 0) return false;
  return rigid.project(rigid.data().penetration).found;
}

/// Pairs closed by rigid bodies on pads with tangential stiffness, all sticking.
PairStates stickingStart(const RigidContact& rigid, const FrictionStates& friction) {
  const RigidContact::Pairs& data = rigid.data();
  const auto tangents = static_cast<Eigen::Index>(data.tangents.size());
  const Eigen::Index pairs = rigid.pairs(), all = pairs * (1 + 2 * tangents);
  RigidContact::Pairs held;
  held.rows = Matrix::Zero(all, rigid.motions());
  held.work = data.work;
  held.penetration = Vector::Zero(all);
  held.stiffness = Vector::Ones(all);
  held.surfaces = data.surfaces;
  held.rows.topRows(pairs) = data.rows;
  held.penetration.head(pairs) = data.penetration;
  held.stiffness.head(pairs) = data.stiffness;
  held.line = data.line;
  held.able = data.able;
  for (Eigen::Index t = 0; t < tangents; ++t)
    for (const double sign : {1.0, -1.0}) {
      const auto first = static_cast<Eigen::Index>(held.line.size());
      held.rows.middleRows(first, pairs) = sign * data.tangents[static_cast<std::size_t>(t)];
      for (Eigen::Index i = 0; i < pairs; ++i) {
        const double stiffness = friction.sites()[static_cast<std::size_t>(i)].tangential;
        const bool holds = data.able[static_cast<std::size_t>(i)] && friction.laws().of(data.line[static_cast<std::size_t>(i)]).rows(2) > 1;
        held.stiffness(first + i) = stiffness > 0.0 ? stiffness : 1.0;
        held.line.push_back(-1 - static_cast<int>(first + i));
        held.able.push_back(holds && stiffness > 0.0);
      }
    }
  RigidContact model(std::move(held));
  const ClosedSet set = model.start();
  PairStates states(static_cast<std::size_t>(pairs));
  for (std::size_t i = 0; i < states.size(); ++i)
    if (set[i]) states[i] = friction.laws().of(data.line[i]).rows(2) > 1 ? PairStatus::Stick : PairStatus::Slip;
  return states;
}

/// States from the slips of a frictionless solution; the force that reverses the slip of a pair is estimated by the stiffness of its pad.
PairStates statesBySlip(const RigidContact& rigid, const FrictionStates& friction, PairStates states, const PairValues& values) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!rigid.data().able[i] || !states[i].closed()) continue;
    const FrictionSite& site = friction.sites()[i];
    ContactTrial trial;
    trial.place = site.place;
    trial.size = site.size;
    trial.slipped = site.slipped;
    trial.force[0] = std::max(values.force(at, 0), 0.0);
    const double pad = site.tangential / (rigid.data().stiffness(at) * rigid.compliance()(at));
    for (int k = 1; k <= 2; ++k) trial.jump[k] = pad * values.jump(at, k);
    states[i] = friction.laws().of(rigid.data().line[i]).project(trial, states[i]);
  }
  return states;
}

/// Search by the methods of FrictionSearch, for problems with bounds in place of a law, and (by pivots) for few pairs with a discontinuous
/// law (cohesion is lost when a pair opens).
FrictionSearch::Result searchOtherwise(OuterSolver::Run& run, FrictionSolves& solves, double innerTolerance, int most) {
  const FrictionStates& friction = *run.problem.friction();
  const ContactSets& sets = *run.problem.sets();
  const RigidContact& rigid = sets.bodies().rigid();
  PairStates start;
  Vector normal;
  FrictionSearch search(rigid, friction.laws(), friction.sites(), solves, most);
  if (run.given) {
    start = friction.statesOf(run.result.state.status);
  } else if (holdsWithoutFriction(rigid)) {
    run.result.state = sets.padState();
    SetSolves loose(run, innerTolerance, true);
    ContactSearch(rigid, loose, kFrictionless).run(sets.closedSet(run.result.state.status));
    run.result.failure.clear();
    const PairValues values = friction.valuesOf(run.result.state);
    run.result.pcgTotal += values.applications;
    run.result.otherApplications += values.applications;
    normal = values.force.col(0).cwiseMax(0.0);
    start = statesBySlip(rigid, friction, friction.statesOf(run.result.state.status), values);
  } else {
    start = stickingStart(rigid, friction);
    run.result.state = friction.stateWith(start);
  }
  return search.run(start, normal);
}

}  // namespace

void searchFriction(OuterSolver::Run& run, double innerTolerance) {
  const FrictionStates& friction = *run.problem.friction();
  const RigidContact& rigid = run.problem.sets()->bodies().rigid();
  FrictionSolves solves(run, innerTolerance);
  FrictionSearch::Result found;
  if (solves.drags()) {
    StateSearch search(rigid, friction.laws(), friction.sites(), solves, run.settings.maximumIterations);
    PairStates start;
    if (run.given) {
      start = friction.statesOf(run.result.state.status);
    } else {
      start = search.start();
      run.result.state = friction.stateWith(start);
    }
    const StateSearch::Result own = search.run(start);
    found.converged = own.converged;
    found.slides = own.slides;
    found.states = own.states;
    found.solves = own.solves;
    found.contraction = own.contraction;
    found.alternating = own.alternating;
  }
  if (!found.converged && found.slides.size() == 0 && solves.goesOn() && found.solves < run.settings.maximumIterations)
    found = searchOtherwise(run, solves, innerTolerance, run.settings.maximumIterations);
  run.result.state.status = friction.statusOf(found.states);
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
