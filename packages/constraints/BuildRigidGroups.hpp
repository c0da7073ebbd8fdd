#pragma once
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>

#include <vector>

namespace suture {

/// Makes the rigid groups of all conditions `Rigid Group`, and replaces the rules, the supports and the prescribed values of their nodes.
/// Whatever other conditions prescribe on these nodes restricts the motion of the group; its reaction counts as that of the group's
/// condition. Masters are the components that determine the free motions best (pivots of a QR decomposition). Local.
/// \param problems  gets: groups of several bodies or with common nodes; conditions on the nodes that would deform the group
void buildRigidGroups(const Mesh& mesh, const std::vector<Condition>& conditions, Constraints& constraints, Problems& problems);

}  // namespace suture
