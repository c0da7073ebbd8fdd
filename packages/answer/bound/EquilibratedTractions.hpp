#pragma once
#include <suture/answer/bound/StarMesh.hpp>

namespace suture {

/// Tractions on the sides of all simplices, in balance with the forces of the elements on their nodes: for each node, the moments of the
/// tractions with its shape function, summed over the sides of a simplex, equal the simplex's force on the node. They are found node by
/// node, as the least change of averaged stresses, so that each simplex is in equilibrium (Ladeveze and Leguillon 1983).
template <int D>
struct EquilibratedTractions {
  /// Dimension x nodes of a side, by columns: tractions on the side in the direction of its normal, at its nodes. [stress]
  Matrix values;
  /// Nodes whose forces cannot be balanced by tractions (concentrated forces, supports at points): largest rest relative to the largest
  /// force, number of nodes, place of the worst one. Over all ranks.
  double rest = 0.0;
  int unbalanced = 0;
  Point worst{0, 0, 0};
};

/// Collective.
template <int D>
EquilibratedTractions<D> equilibratedTractions(const StarMesh<D>& mesh);

}  // namespace suture
