#pragma once
#include <suture/monolithic/MonolithicContact.hpp>

namespace suture {

/// Contact with laws that restrict sliding or never open a pair: the same search as the decomposed methods (StateSearch), on dense linear
/// problems (DelassusFriction), to 1e-11 of the forces. Local.
///
/// Equilibria with Coulomb's law need neither exist nor be unique. If a body slides away, `slides` holds the motion and x is empty.
///
/// \param start       initial states of the pairs; empty: those of rigid bodies on pads
/// \param iterations  maximum number of linear problems
/// \param step        called after each linear solve
ContactSolution solveFriction(const CondensedContact& problem, const std::vector<ContactState>& start, int iterations,
                              const std::function<void(const ActiveSetStep&)>& step);

}  // namespace suture
