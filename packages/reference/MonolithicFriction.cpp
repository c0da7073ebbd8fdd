#include <suture/reference/FrictionConditions.hpp>
#include <suture/reference/MonolithicFriction.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

using Conditions = FrictionConditions;
using Unknowns = FrictionConditions::Unknowns;
using States = FrictionConditions::States;

constexpr int newtonSteps = 60;      // maximum number of steps per call: it converges in few, or cycles
constexpr int halvings = 8;          // maximum number of halvings of a step that does not reduce the residual
constexpr int slidingSteps = 10;     // steps of a sliding body without new contact, each sixteen times as long as the last
constexpr int trescaProblems = 200;  // maximum number of problems of the fixed point
constexpr int sweepsOfBlocks = 200;

/// Norm of the changes of bounds; infinite bounds are ignored.
double distance(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i]) && std::isfinite(b[i])) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

bool alike(const Conditions::Evaluation& a, const Conditions::Evaluation& b) {
  return std::equal(a.branches.begin(), a.branches.end(), b.branches.begin(),
                    [](const Conditions::Branch& one, const Conditions::Branch& other) { return one.like(other); });
}

class FrictionSearch {
 public:
  FrictionSearch(const CondensedContact& problem, int iterations, const std::function<void(const ActiveSetStep&)>& tell)
      : problem_(problem), delassus_(problem), conditions_(problem, delassus_), left_(iterations), tell_(tell) {
    states_.assign(conditions_.pairs().size(), PairStatus::Slip);
    x_ = {Vector::Zero(conditions_.rows()), Vector::Zero(conditions_.motions())};
  }

  ContactSolution run(const States& start, FrictionWay way);

 private:
  enum class Ended { Converged, Slides, Not };

  Ended newton(Unknowns& x, const Vector* bounds);
  bool startFrom(const States& states);
  bool begin();
  bool tresca(Unknowns& x, const Vector& bounds, FrictionWay way);
  Ended fixedPoint(FrictionWay way);
  Conditions::Evaluation evaluate(const Unknowns& x, const Vector* bounds) const {
    return bounds ? conditions_.evaluate(x, *bounds) : conditions_.evaluate(x, states_);
  }
  void tell(const Conditions::Evaluation& before, const Conditions::Evaluation& after, const Unknowns& x) const;
  ContactSolution result(Ended ended) const;

  const CondensedContact& problem_;
  const Delassus delassus_;
  const Conditions conditions_;
  int left_;
  const std::function<void(const ActiveSetStep&)>& tell_;
  Unknowns x_;
  States states_;
  Vector slides_;
  double contraction_ = 0.0;
};

void FrictionSearch::tell(const Conditions::Evaluation& before, const Conditions::Evaluation& after, const Unknowns& x) const {
  double displacements = std::max(delassus_.open().cwiseAbs().maxCoeff(), problem_.bounds.cwiseAbs().maxCoeff());
  if (conditions_.motions() > 0) displacements = std::max(displacements, (delassus_.motions() * x.place).cwiseAbs().maxCoeff());
  ActiveSetStep step;
  for (std::size_t p = 0; p < after.branches.size(); ++p) {
    step.active += after.branches[p].pressed;
    step.changed += !after.branches[p].like(before.branches[p]);
  }
  step.residual = displacements > 0.0 ? after.violation / displacements : after.violation;
  step.energy = delassus_.energy(x.force, x.place) - 0.5 * x.force.dot(after.jump);
  tell_(step);
}

/// Newton's method from x, by the laws or with frozen bounds. A step that does not reduce the residual is halved.
FrictionSearch::Ended FrictionSearch::newton(Unknowns& x, const Vector* bounds) {
  Conditions::Evaluation now = evaluate(x, bounds);
  double drag = 1.0;
  int sliding = 0, rises = 0;
  for (int k = 0; k < newtonSteps; ++k) {
    if (!bounds) states_ = now.states;
    if (now.error <= 1.0) return Ended::Converged;
    if (!bounds && left_-- <= 0) return Ended::Not;
    Unknowns next;
    const Conditions::Solved solved = conditions_.solve(now.branches, x, drag, next);
    if (solved == Conditions::Solved::Not) return Ended::Not;
    Conditions::Evaluation after = evaluate(next, bounds);
    if (solved == Conditions::Solved::Dragged) {
      // The loads move a loose body in growing steps until its pairs change: then something stops or holds it.
      const bool same = after.defect.norm() > 0.9 * now.defect.norm() && alike(after, now);
      sliding = same ? sliding + 1 : 0;
      drag = same ? drag / 16.0 : 1.0;
      if (sliding > slidingSteps) {
        slides_ = next.place - x.place;
        return Ended::Slides;
      }
    } else if (after.error > 1.0 && after.withinRounding && after.merit > 0.5 * now.merit && alike(after, now)) {
      // Only round-off is left.
      if (after.merit < now.merit) x = next;
      if (after.merit < now.merit && !bounds) states_ = after.states;
      return Ended::Converged;
    } else if (!(after.merit < now.merit) && after.error > 1.0) {
      Unknowns best = next;
      Conditions::Evaluation least = after;
      double t = 1.0;
      for (int halved = 0; halved < halvings; ++halved) {
        t *= 0.5;
        const Unknowns tried{x.force + t * (next.force - x.force), x.place + t * (next.place - x.place)};
        Conditions::Evaluation at = evaluate(tried, bounds);
        if (at.merit < least.merit) best = tried, least = at;
        if (at.merit < (1.0 - 1e-4 * t) * now.merit) break;
      }
      if (!(least.merit < now.merit) && ++rises > 3) return Ended::Not;
      next = best;
      after = least;
    }
    tell(now, after, next);
    x = next;
    now = after;
  }
  return Ended::Not;
}

/// Starts from the solution of the linear problem of given states. False if it has no solution.
bool FrictionSearch::startFrom(const States& states) {
  Unknowns next;
  if (conditions_.solve(conditions_.branchesOf(states), x_, 1.0, next) == Conditions::Solved::Not) return false;
  x_ = next;
  states_ = states;
  return true;
}

/// Solves a Tresca problem. \param x  start and result
bool FrictionSearch::tresca(Unknowns& x, const Vector& bounds, FrictionWay way) {
  if (way != FrictionWay::FixedPointBlocks) {
    Unknowns found = x;
    const Ended ended = newton(found, &bounds);
    if (ended == Ended::Converged) x = found;
    if (ended != Ended::Not) return ended == Ended::Converged;
  }
  return conditions_.solveByBlocks(x, bounds, sweepsOfBlocks).error <= 1.0;
}

/// Starts from the frictionless solution, or the one with all pairs sticking. False if neither exists.
bool FrictionSearch::begin() {
  Vector bounds = conditions_.bounds(x_, states_);
  for (double& bound : bounds)
    if (std::isfinite(bound)) bound = 0.0;
  Unknowns found = x_;
  if (tresca(found, bounds, FrictionWay::Newton)) {
    x_ = found;
    return true;
  }
  slides_.resize(0);
  return startFrom(States(states_.size(), PairStatus::Stick));
}

FrictionSearch::Ended FrictionSearch::fixedPoint(FrictionWay way) {
  Vector bounds = conditions_.bounds(x_, states_);
  double last = 0.0;
  Ended best = Ended::Not;
  for (int k = 0; k < trescaProblems; ++k) {
    const bool found = tresca(x_, bounds, way);
    const bool tries = way == FrictionWay::Newton && (k & (k - 1)) == 0;  // less and less often
    if (tries || !found) {
      Unknowns x = x_;
      const States before = states_;
      const Ended ended = newton(x, nullptr);
      if (ended == Ended::Converged) {
        x_ = x;
        return ended;
      }
      states_ = before;
      best = ended;
    }
    if (!found) return best;  // no equilibrium within the bounds, hence no new bounds
    const Conditions::Evaluation now = conditions_.evaluate(x_, states_);
    states_ = now.states;
    if (now.error <= 1.0) return Ended::Converged;
    const Vector next = conditions_.bounds(x_, states_);
    const double change = distance(next, bounds);
    if (k > 0 && last > 0.0 && change > 1e-8 * next.norm()) contraction_ = change / last;
    last = change;
    bounds = next;
  }
  return Ended::Not;
}

ContactSolution FrictionSearch::run(const States& start, FrictionWay way) {
  if (!start.empty() && startFrom(start)) {
    Unknowns x = x_;
    if (newton(x, nullptr) == Ended::Converged) {
      x_ = x;
      return result(Ended::Converged);
    }
    states_.assign(states_.size(), PairStatus::Slip);
    x_ = {Vector::Zero(conditions_.rows()), Vector::Zero(conditions_.motions())};
  }
  if (!begin()) return result(Ended::Not);
  slides_.resize(0);
  return result(fixedPoint(way));
}

ContactSolution FrictionSearch::result(Ended ended) const {
  ContactSolution solution;
  solution.converged = ended == Ended::Converged;
  solution.contraction = contraction_;
  const Conditions::Evaluation last = conditions_.evaluate(x_, states_);
  solution.states = last.states;
  solution.force = x_.force - last.residual;  // the projection: round-off puts no pair in tension or outside its cone
  if (!solution.converged) solution.force = x_.force;
  for (const CondensedContact::Pair& pair : conditions_.pairs())
    for (int k = 0; k < pair.rows; ++k) solution.active.push_back(last.states[&pair - conditions_.pairs().data()].closed());
  if (ended == Ended::Slides) {
    solution.failure = "no equilibrium exists";
    solution.slides = delassus_.kernel() * slides_;
    return solution;
  }
  if (!solution.converged)
    solution.failure = "friction: neither Newton's method nor the fixed point of Tresca problems converged; an equilibrium need not exist";
  solution.x = delassus_.displacement(solution.force, x_.place);
  return solution;
}

}  // namespace

ContactSolution solveFriction(const CondensedContact& problem, const std::vector<ContactState>& start, int iterations,
                              const std::function<void(const ActiveSetStep&)>& step, FrictionWay way) {
  return FrictionSearch(problem, iterations, step).run(start, way);
}

}  // namespace suture
