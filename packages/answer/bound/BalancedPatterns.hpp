#pragma once
#include <suture/answer/bound/PressedSides.hpp>

namespace suture {

/// Nodal forces of at most four nodes of a contact that have no resultant; the largest amplitude is 1.
struct BalancedPattern {
  int size = 0;
  std::array<int, 4> nodes{};
  std::array<double, 4> amplitudes{};
};

/// Patterns that span all self-balanced nodal forces of sides on a straight line (2D) or in a plane (3D) that are connected by nodes: a
/// function that is affine on each side, with values of mid-edge nodes in the middle, and whose parts on two sides with a common edge (2D:
/// vertex) continue each other, is one affine function. Each pattern is such a condition: a mid-edge node with its two vertices, or a
/// vertex of one side with the vertices of a neighbour. Sides that share a vertex only, and no chain of edges around it, are connected
/// there. On curved lines and surfaces patterns are balanced in the plane of the neighbour. Local.
std::vector<BalancedPattern> balancedPatterns(const PressedSides& sides);

}  // namespace suture
