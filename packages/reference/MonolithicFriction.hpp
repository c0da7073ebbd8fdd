#pragma once
#include <suture/reference/MonolithicContact.hpp>

namespace suture {

/// Way to a solution with friction. The first one takes the others where it fails.
enum class FrictionWay {
  Newton,           ///< semismooth Newton's method, from a frictionless and a Tresca problem
  FixedPoint,       ///< Tresca problems with the bounds of the last normal forces, each by Newton's method where that converges
  FixedPointBlocks  ///< the same, each by block Gauss-Seidel, whose energy falls: it always ends
};

/// Contact whose laws restrict sliding, or never open a pair: forces f of all rows and amplitudes a with
///     w = h - H f + C Z a,    f = projection of f + c w by the laws,    (C Z)^T f = Z^T load
/// (FrictionConditions), to 1e-11 of the forces. Local.
///
/// Equilibria with Coulomb's law need neither exist nor be unique. Where a body slides away, `slides` holds the motion and x is empty.
///
/// \param start       states of the pairs to start from; empty: a frictionless problem, or all pairs stuck where only friction holds a body
/// \param iterations  most steps of Newton's method by the laws; the fixed point ends by itself
/// \param step        told of each linear solve
ContactSolution solveFriction(const CondensedContact& problem, const std::vector<ContactState>& start, int iterations,
                              const std::function<void(const ActiveSetStep&)>& step, FrictionWay way = FrictionWay::Newton);

}  // namespace suture
