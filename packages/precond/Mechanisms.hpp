#pragma once
#include <suture/precond/PrimalConstraints.hpp>

namespace suture {

/// Columns: translations and optionally rotations of some unknowns about their centre, scaled to order one. Local.
Matrix rigidMotionsOf(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withRotation);

/// Makes unknowns primal alone until a choice leaves no mechanism, by two rules on rigid motions. First, the constraints of every local
/// problem must determine its kernel, otherwise its inverse does not exist. Second, the constraints that two neighbours share on seams must
/// determine all motions of their two kernels there. Counter-example: in a strip of subdomains in which each is tied to the next by one
/// average, every hinge is held, but the strip is a linkage, and the condition number is unbounded. Points are added one by one, each time
/// the one that moves most in the remaining motions. A choice without mechanisms is unchanged. Collective.
void stopMechanisms(const InterfaceSpace& space, const LocalProblems& locals, PrimalChoice& choice);

}  // namespace suture
