#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Settles what a solution leaves open, from its pair forces, gaps and displacements alone, in the same way for all solvers:
/// - Closed pairs without force are opened; open pairs without a gap are `touching`.
/// - Rigid motions of bodies that change no pair force and close no pair are stored in solution.neutral: the position along them is not
///   determined.
/// - Along these motions each body is moved to the least displacements (mean square over the nodes) without penetration, independent of its
///   position in the solution.
/// A pair carries a force above 1e-12 of the largest on either of its bodies, and holds the pair's bodies above 1e-8; it touches if its gap
/// is below 1e-6 of the largest change of gaps of its bodies. Collective.
/// \param meshes  those of solution.displacement; their lifts, if any, receive the motions
/// \param model  model with the loads
/// \param carried  by body, the largest forces on the path of load steps before: less than their round-off counts as no force; empty: none
void settleNeutralMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactLaws& laws,
                          const std::vector<BodyForces>& carried, Solution& solution);

/// One sentence per motion, for the user.
std::string inWords(const NeutralMotion& motion);

/// The motions that make a solution useless: a loaded body slides or turns freely in both directions. Empty: none.
std::string undetermined(const std::vector<NeutralMotion>& motions);

}  // namespace suture
