#include <suture/monolithic/Delassus.hpp>
#include <suture/monolithic/MonolithicContact.hpp>
#include <suture/search/DelassusProblem.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// Reports each solve.
class MonitoredProblem : public DelassusProblem {
 public:
  MonitoredProblem(const RigidBodyModel& rigid, const Delassus& delassus, const CondensedContact& problem,
                   const std::function<void(const ActiveSetStep&)>& tell)
      : DelassusProblem(rigid, delassus.compliance(), delassus.open(), delassus.rounding()),
        rigid_(rigid),
        delassus_(delassus),
        problem_(problem),
        tell_(tell) {}

  ContactAnswer solve(const PairStates& states, double tolerance) override {
    ContactAnswer answer = DelassusProblem::solve(states, tolerance);
    double displacements = std::max(delassus_.open().cwiseAbs().maxCoeff(), problem_.bounds.cwiseAbs().maxCoeff());
    if (rigid_.motions() > 0) displacements = std::max(displacements, (rigid_.data().rows * state().amplitude).cwiseAbs().maxCoeff());
    if (displacements == 0.0) displacements = 1.0;
    ActiveSetStep step;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto at = Eigen::Index(i);
      if (!rigid_.data().canChange[i]) continue;
      const bool closed = states[i].closed();
      const double force = answer.force(at, 0), penetration = answer.jump(at, 0);
      step.active += closed;
      step.changed += closed ? force < -answer.forceTolerance(at) : penetration > answer.jumpTolerance(at);
      const double by = closed ? -force * delassus_.compliance()(at, at) : penetration;
      step.residual = std::max(step.residual, by / displacements);
    }
    step.energy = delassus_.energy(state().force, state().amplitude);
    tell_(step);
    return answer;
  }

 private:
  const RigidBodyModel& rigid_;
  const Delassus& delassus_;
  const CondensedContact& problem_;
  const std::function<void(const ActiveSetStep&)>& tell_;
};

}  // namespace

ContactSolution solveCondensedContact(const CondensedContact& problem, std::vector<char> active, int iterations,
                                      const std::function<void(const ActiveSetStep&)>& step) {
  const Delassus delassus(problem);
  RigidBodyModel rigid = delassus.rigidBodyModel();
  MonitoredProblem oracle(rigid, delassus, problem, step);
  ClosedSet start = active;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = start[i] && rigid.data().canChange[i];
  if (active.empty() || rigid.loosens(start)) start = rigid.start();
  const StateSearch::Result found = StateSearch(rigid, oracle, iterations).run(statesOf(start));

  ContactSolution result;
  result.converged = found.converged;
  if (!found.converged) {
    result.failure = found.slides.size() > 0 ? "the loads push a body away from all contacts that could hold it"
                                             : "the active set did not converge within the given iterations";
  }
  result.force = found.normal.size() > 0 ? found.normal : Vector::Zero(rigid.pairs());
  result.active = closedSet(found.states);
  // Prescribed rows carry no force; they are active if they touch.
  for (std::size_t i = 0; i < result.active.size(); ++i)
    if (!rigid.data().canChange[i]) result.active[i] = problem.bounds[Eigen::Index(i)] <= 0.0;
  result.x = delassus.displacement(result.force, oracle.state().amplitude);
  return result;
}

}  // namespace suture
