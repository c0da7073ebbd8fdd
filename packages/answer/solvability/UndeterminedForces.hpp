#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Makes contact forces unique. If closed pairs share nodes (a node in several contacts, tied sides that meet in one point) or nodes held
/// by boundary conditions, several sets of contact forces cause the same displacements: they differ by a null vector of the transposed
/// closed rows. Among the forces that the contact laws allow, those with the least traction norm are kept,
///     sum over the pairs of |force|^2 / tributary length or area,
/// which are the same for all solvers and any number of ranks. solution.sharedForces names the contacts concerned. Collective.
/// \param meshes  those of solution.displacement
void settleContactForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ContactLaws& laws,
                         const std::vector<std::string>& contacts, Solution& solution);

/// One sentence on these forces, for the user.
std::string inWords(const UndeterminedForces& forces);

}  // namespace suture
