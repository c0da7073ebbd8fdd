#pragma once
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>

#include <vector>

namespace suture {

/// Dirichlet and bilateral rows of all conditions, brought together at each node.
///
/// Displacement gives a row a prescribed component. Bilateral gives u.n = 0 with the outward normal averaged (by size) over all bilateral
/// sides that meet at the node, whichever condition they come from; where they meet at more than 45 degrees, each has a row of its own.
/// Axisymmetric meshes: u_x = 0 on the axis, said by no condition.
/// The rows whose directions are independent of those before decide, at most one a component. One: it is axis 0 of the rule (Cartesian
/// axes, if it is Cartesian). Two in space: axes 0 and 1 span their plane, the first along the first row (Cartesian axes, if they span it).
/// As many as components: the node is fixed, in Cartesian axes. Directions need not be orthogonal.
/// Result sorted by node. Local.
/// \param problems  gets rows that contradict each other: the two conditions, place, values, how many nodes
/// Conditions that have factors (Condition::factor) must agree factor by factor.
/// \param supports  gets the conditions behind the rules, sorted by node
/// \param prescribed  gets the parts of the values by factor (Constraints::prescribed)
std::vector<NodeRule> nodalRules(const Mesh& mesh, const std::vector<Condition>& conditions, Problems& problems,
                                 std::vector<Support>& supports, std::vector<std::vector<RuleValue>>& prescribed);

}  // namespace suture
