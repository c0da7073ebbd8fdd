#pragma once
#include <suture/answer/Balancing.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/MakeSubdomains.hpp>

#include <optional>
#include <string>

namespace suture {

/// True if the settings of a scene request an error bound, or results that follow from it (accuracy, strict error bars); it needs balanced
/// forces. Local.
bool wantsErrorBound(const Parameters& settings);

/// Result of balanceForces().
struct BalancedForces {
  std::optional<Balancing> balancing;
  std::string reason;  ///< reason why there is none; else empty
};

/// Balances the forces of a state of an interface problem for its pair states, which are kept. One application of the preconditioner's
/// local solutions before averaging balances them up to the accuracy of its coarse solve and its stored inverses; it is repeated for the
/// rest, up to round-off. Pairs that slip by Coulomb's law keep the friction forces that they have at the state, since only friction with
/// given bounds has an energy: the states in Balancing::forces have these bounds. Not available if only springs of slipping pairs hold a
/// body. Collective; the same on all ranks, except for the parts of each rank. \param preconditioner  of the problem; it is set up
/// again if it was made for other pair states
BalancedForces balanceForces(const InterfaceProblem& problem, const InterfaceState& state, Preconditioner& preconditioner,
                             const Subdomains& subdomains);

}  // namespace suture
