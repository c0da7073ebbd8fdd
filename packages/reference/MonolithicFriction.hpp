#pragma once
#include <suture/reference/MonolithicContact.hpp>

namespace suture {

/// Solution method with friction. The first one falls back to the others if it fails.
enum class FrictionWay {
  Newton,           ///< semismooth Newton method, from a frictionless and a Tresca problem
  FixedPoint,       ///< Tresca problems with bounds from the last normal forces, each by Newton's method if it converges
  FixedPointBlocks  ///< the same, each by block Gauss-Seidel with decreasing energy, which always terminates
};

/// Contact with laws that restrict sliding or never open a pair: forces f of all rows and amplitudes a with
///     w = h - H f + C Z a,    f = projection of f + c w by the laws,    (C Z)^T f = Z^T load
/// (FrictionConditions), to 1e-11 of the forces. Local.
///
/// Equilibria with Coulomb's law need neither exist nor be unique. If a body slides away, `slides` holds the motion and x is empty.
///
/// \param start       initial states of the pairs; empty: a frictionless problem, or all pairs sticking if only friction holds a body
/// \param iterations  maximum number of Newton steps with the laws; the fixed point has its own limit
/// \param step        called after each linear solve
ContactSolution solveFriction(const CondensedContact& problem, const std::vector<ContactState>& start, int iterations,
                              const std::function<void(const ActiveSetStep&)>& step, FrictionWay way = FrictionWay::Newton);

}  // namespace suture
