#include <suture/contact/DelassusProblem.hpp>
#include <suture/reference/Delassus.hpp>
#include <suture/reference/MonolithicContact.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// Reports each solve.
class MonitoredProblem : public DelassusProblem {
 public:
  MonitoredProblem(const RigidContact& rigid, const Delassus& delassus, const CondensedContact& problem,
                   const std::function<void(const ActiveSetStep&)>& tell)
      : DelassusProblem(rigid, delassus.compliance(), delassus.open(), delassus.rounding()),
        rigid_(rigid),
        delassus_(delassus),
        problem_(problem),
        tell_(tell) {}

  ContactAnswer solve(const ClosedSet& closed, int level) override {
    ContactAnswer answer = DelassusProblem::solve(closed, level);
    double displacements = std::max(delassus_.open().cwiseAbs().maxCoeff(), problem_.bounds.cwiseAbs().maxCoeff());
    if (rigid_.motions() > 0) displacements = std::max(displacements, (rigid_.data().rows * state().amplitude).cwiseAbs().maxCoeff());
    if (displacements == 0.0) displacements = 1.0;
    ActiveSetStep step;
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const auto at = Eigen::Index(i);
      if (!rigid_.data().canChange[i]) continue;
      step.active += closed[i] != 0;
      const bool wrong =
          closed[i] ? answer.force[at] < -answer.forceTolerance[at] : answer.penetration[at] > answer.penetrationTolerance[at];
      step.changed += wrong;
      const double by = closed[i] ? -answer.force[at] * delassus_.compliance()(at, at) : answer.penetration[at];
      step.residual = std::max(step.residual, by / displacements);
    }
    step.energy = delassus_.energy(state().force, state().amplitude);
    tell_(step);
    return answer;
  }

 private:
  const RigidContact& rigid_;
  const Delassus& delassus_;
  const CondensedContact& problem_;
  const std::function<void(const ActiveSetStep&)>& tell_;
};

}  // namespace

ContactSolution solveCondensedContact(const CondensedContact& problem, std::vector<char> active, int iterations,
                                      const std::function<void(const ActiveSetStep&)>& step) {
  const Delassus delassus(problem);
  RigidContact rigid = delassus.rigidContact();
  MonitoredProblem oracle(rigid, delassus, problem, step);
  ClosedSet start = active;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = start[i] && rigid.data().canChange[i];
  if (active.empty() || rigid.loosens(start)) start = rigid.start();
  const ContactSearch::Result found = ContactSearch(rigid, oracle, iterations).run(start);

  ContactSolution result;
  result.converged = found.converged;
  result.failure =
      found.failure.empty() && !found.converged ? "the active set did not converge within the given iterations" : found.failure;
  result.force = found.force;
  result.active = found.closed;
  // Prescribed rows carry no force; they are active if they touch.
  for (std::size_t i = 0; i < result.active.size(); ++i)
    if (!rigid.data().canChange[i]) result.active[i] = problem.bounds[Eigen::Index(i)] <= 0.0;
  result.neutral = found.neutral;
  result.x = delassus.displacement(found.force, oracle.state().amplitude);
  return result;
}

}  // namespace suture
