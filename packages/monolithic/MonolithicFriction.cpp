#include <suture/monolithic/DelassusFriction.hpp>
#include <suture/monolithic/MonolithicFriction.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Forces of the rows that the laws allow: round-off puts no pair in tension or outside its cone.
Vector allowed(const CondensedContact& problem, const PairStates& states, Vector force) {
  for (std::size_t p = 0; p < states.size(); ++p) {
    const CondensedContact::Pair& pair = problem.pairs[p];
    if (pair.law->separates()) force(pair.first) = std::max(0.0, force(pair.first));
    if (pair.rows == 1 || states[p].status != PairStatus::Stick || !pair.law->separates()) continue;
    auto tangential = force.segment(pair.first + 1, pair.rows - 1);
    const double size = tangential.norm(), largest = states[p].largest(force(pair.first));
    if (size > largest && (states[p].bound > 0.0 || states[p].friction > 0.0)) tangential *= largest / size;
  }
  return force;
}

}  // namespace

ContactSolution solveFriction(const CondensedContact& problem, const std::vector<ContactState>& start, int iterations,
                              const std::function<void(const ActiveSetStep&)>& step) {
  const Delassus delassus(problem);
  DelassusFriction solver(problem, delassus, step);
  StateSearch search(solver.rigid(), solver.laws(), solver.sites(), solver, iterations);
  const StateSearch::Result found = search.run(start.empty() ? search.start() : start);

  ContactSolution solution;
  solution.converged = found.converged;
  solution.contraction = std::max(found.contraction, 0.0);
  solution.states = found.states;
  for (const CondensedContact::Pair& pair : problem.pairs)
    for (int k = 0; k < pair.rows; ++k) solution.active.push_back(found.states[&pair - problem.pairs.data()].closed());
  solution.force = solver.force().size() > 0 ? solver.force() : Vector::Zero(problem.bounds.size());
  if (found.slides.size() > 0) {
    solution.failure = "no equilibrium exists";
    solution.slides = delassus.kernel() * solver.amplitudesOf(found.slides);
    return solution;
  }
  if (found.converged)
    solution.force = allowed(problem, found.states, solution.force);
  else
    solution.failure = "friction: found no states of the pairs that agree with the laws; an equilibrium need not exist";
  if (solver.amplitude().size() == delassus.motions().cols()) solution.x = delassus.displacement(solution.force, solver.amplitude());
  return solution;
}

}  // namespace suture
