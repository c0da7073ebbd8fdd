#pragma once
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>

#include <vector>

namespace suture {

/// Nodal rules: Dirichlet and bilateral rows of all conditions, combined at each node.
///
/// Displacement gives one row per prescribed component, or one along its direction.
/// Bilateral gives u.n = 0 with the outward normal averaged (by size) over all bilateral sides that meet at the node, regardless of
/// their conditions; sides that meet at more than 45 degrees give separate rows.
/// Axisymmetric meshes: u_x = 0 on the axis is imposed automatically.
/// A row counts if its direction is independent of the preceding ones, up to the number of components. One row: axis 0 of the rule
/// (Cartesian axes if the direction is Cartesian). Two rows in 3D: axes 0 and 1 span their plane, axis 0 along the first row (Cartesian
/// axes if they span the plane). As many rows as components: the node is fixed, in Cartesian axes. Directions need not be orthogonal.
/// Result sorted by node. Local.
/// \param problems  gets contradictory rows: the two conditions, place, values, number of nodes.
/// Conditions that have factors (Condition::factor) must agree factor by factor.
/// \param supports  gets the conditions behind the rules, sorted by node
/// \param prescribed  gets the parts of the values by factor (Constraints::prescribed)
std::vector<NodeRule> nodalRules(const Mesh& mesh, const std::vector<Condition>& conditions, Problems& problems,
                                 std::vector<Support>& supports, std::vector<std::vector<RuleValue>>& prescribed);

}  // namespace suture
