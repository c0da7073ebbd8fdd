#pragma once
#include <suture/precond/PrimalConstraints.hpp>

namespace suture {

/// Columns: translations, and if asked for the rotations, of some unknowns about their centre, of the order of one. Local.
Matrix rigidMotionsOf(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withRotation);

/// Makes unknowns primal alone until a choice leaves no mechanism, by two rules about rigid motions. First, the constraints of every local
/// problem tell its kernel, or its inverse does not exist. Second, the constraints that two neighbours share on seams tell all that the
/// kernels of the two move there: a strip of subdomains of which each hangs on the next by one average is a linkage of hinges; every one of
/// them is held, the strip is not, and the condition has no bound. Points are added one by one, each the one that moves most in what is
/// left. A choice without mechanisms stays as it is. Collective.
void stopMechanisms(const InterfaceSpace& space, const LocalProblems& locals, PrimalChoice& choice);

}  // namespace suture
