#pragma once
#include <suture/base/Types.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

/// Looks at a solution from its pair forces, gaps and displacements alone, the same for all solvers:
/// - closed pairs that carry no force become open ones; open ones without a gap are `touching`;
/// - rigid motions of bodies that change no pair force and close no pair are put down in solution.neutral: nothing determines the bodies'
///   places along them;
/// - along these the bodies are put where displacements are least (mean square over the nodes) without penetration, whatever the solver
///   left there.
/// A pair carries a force above 1e-12 of the largest on either of its bodies, and holds it above 1e-8; it touches where its gap is below
/// 1e-6 of the most by which gaps of its bodies have changed. Collective.
/// \param meshes  those of solution.displacement; their lifts, if they have any, take up the motions  \param model  whose loads act
void settleNeutralMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactLaws& laws,
                          Solution& solution);

/// A sentence a motion, for the user.
std::string inWords(const NeutralMotion& motion);

/// The motions that make a solution useless as it stands: a loaded body slides or turns freely in both senses. Empty: none.
std::string undetermined(const std::vector<NeutralMotion>& motions);

}  // namespace suture
