#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <string>
#include <vector>

namespace suture {

/// A node whose displacement components are not simply the Cartesian ones, all free: what is prescribed there, and in which axes.
/// The local component k of the displacement u is axes[k] . u ; a fixed one has the given value. Axes are orthonormal.
struct NodeRule {
  int node = -1;
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<bool, 3> fixed{{false, false, false}};
  Point value{0, 0, 0};  ///< of the fixed components [length]
};

/// Two facing nodes on a contact line: (u_A - u_B) . normal <= gap. One unit normal a pair, from side A to side B.
struct ContactPair {
  int id = -1;     ///< 0..pairs-1 over the whole scene, along the lines
  int line = -1;   ///< which contact of the scene (its place in the list `Contact`)
  int piece = -1;  ///< which connected component of Gamma_c
  int nodeA = -1, nodeB = -1;
  Point normal{0, 0, 0};
  double gap = 0.0;         ///< initial gap along the normal [length]; negative: interference
  double length = 0.0;      ///< tributary length on side A: integral of its hat function [length]; axisymmetric: times 2 pi r [area]
  double arc = 0.0;         ///< arc length from the first node of its line on side A
  Point position{0, 0, 0};  ///< of node A
};

/// A connected component of Gamma_c.
struct ContactPiece {
  std::string name;        ///< of the contact line; "<line> 2" for its second component, "a + b" for lines that touch
  std::vector<int> pairs;  ///< ids
  int bodyA = -1, bodyB = -1;
};

/// All that restricts the displacements of a scene: Dirichlet and bilateral rows as nodal rules, contact pairs and pieces. On rank 0, for
/// the whole mesh.
struct Constraints {
  std::vector<NodeRule> rules;     ///< at most one a node, sorted by node
  std::vector<ContactPair> pairs;  ///< pairs[i].id == i
  std::vector<ContactPiece> pieces;
};

/// u_local = Q u for one node: row k of Q is axis k. `dimension` x `dimension`.
Matrix axesOf(const NodeRule& rule, int dimension);

}  // namespace suture
