#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

/// Makes contact forces unique. Where closed pairs share nodes (a node in several contacts, glued sides that meet in one point) or meet
/// nodes that boundary conditions hold, several sets of contact forces cause the same displacements: they differ by a null vector of the
/// transposed closed rows. Of these forces those are kept whose traction has the least norm,
///     sum over the pairs of |force|^2 / tributary length or area,
/// among all that the laws of the contacts allow: the same for all solvers and on any number of ranks. solution.sharedForces names the
/// contacts concerned. Collective.
/// \param meshes  those of solution.displacement
void settleContactForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ContactLaws& laws,
                         const std::vector<std::string>& contacts, Solution& solution);

/// A sentence about them, for the user.
std::string inWords(const UndeterminedForces& forces);

}  // namespace suture
