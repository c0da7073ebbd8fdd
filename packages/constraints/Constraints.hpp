#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/constraints/ContactState.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <array>
#include <string>
#include <vector>

namespace suture {

/// A node whose displacement components are not simply the Cartesian ones, all free: prescribed values and axes.
/// The local component k of the displacement u is axes[k] . u ; a fixed one has the given value. Axes are orthonormal.
struct NodeRule {
  int node = -1;
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<bool, 3> fixed{{false, false, false}};
  Point value{0, 0, 0};  ///< values of the fixed components [length]
};

/// Share of a boundary condition in the force that holds a node: along . force, in its direction. The shares of a node add up to the force
/// along the fixed axes of its rule. Conditions that prescribe the same direction share alike; a condition whose direction the others hold
/// already has no share.
struct Support {
  int node = -1;
  int condition = -1;  ///< place in Constraints::conditions
  Point direction{0, 0, 0}, along{0, 0, 0};
};

/// A direction along which an elastic support resists a node of a side of an element: rigid motions that move it are held.
struct SpringDirection {
  int element = -1, node = -1;
  Point direction{0, 0, 0};
};

/// A node's share in the condition of a contact pair: weight normal . u(node).
struct PairEnd {
  int node = -1;
  double weight = 0.0;  ///< weights of side A add up to a positive number, those of side B to a negative one
};

/// One unilateral condition of a contact: sum over its ends of weight normal . u(node) <= gap, that is (u_A - u_B) . normal <= gap.
/// One unit normal a pair, from side A to side B. The first end is the node that carries the pair (its contact force acts there), with
/// weight 1 on side A, -1 on side B (others only where a mortar covers a quadratic element in part). Of matching sides a pair has one node
/// of each; with mortar it has the mean of several on the other side; with a rigid obstacle none.
struct ContactPair {
  int id = -1;     ///< 0..pairs-1 over the whole scene, in the order of the contacts
  int line = -1;   ///< contact of the scene (place in the list `Contact`)
  int piece = -1;  ///< connected component of Gamma_c
  std::vector<PairEnd> ends;
  Point normal{0, 0, 0};
  double gap = 0.0;         ///< initial gap along the normal [length]; negative: interference
  double length = 0.0;      ///< tributary length: integral of the carrying node's hat function [length]; axisymmetric: times 2 pi r [area]
  double arc = 0.0;         ///< in the plane: arc length from the first node of its run of the carrying side [length]; for output
  Point position{0, 0, 0};  ///< position of the carrying node

  int node() const { return ends.front().node; }  ///< carrying node

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.id), each(self.line), each(self.piece), each(self.ends), each(self.normal);
    each(self.gap), each(self.length), each(self.arc), each(self.position);
  }
};

/// Decision of a solver about a pair; its gap and pressure follow from the displacements.
struct PairForce {
  int id = -1;
  ContactState state;
  double force = 0.0;  ///< > 0 compressive [force]
};

/// A pair of two nodes that stand opposite to each other.
std::vector<PairEnd> matchingEnds(int nodeA, int nodeB);

/// Resultant of a pair with this contact force on the bodies as a whole: the force of a rigid obstacle on them; zero between bodies.
/// [force]
Point obstacleForce(const ContactPair& pair, double force);

/// The end of a second-order side on the axis of a body of revolution. Its shape function has no integral over the circle: no pressure has
/// a force there, no pair stands for it, and nothing is decided by it. The values shown there follow from the two pairs beside it.
struct AxisPoint {
  std::array<int, 2> pairs{{-1, -1}};          ///< ids, the nearer one first
  std::array<double, 2> pressure{{1.0, 0.0}};  ///< weights of their pressures: of a + b r^2 whose means over both are these
  std::array<double, 2> value{{1.0, 0.0}};     ///< weights of their values at the nodes: of a + b r^2 through these
  int node = -1;
  double arc = 0.0;
  Point position{0, 0, 0}, normal{0, 0, 0};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pairs), each(self.pressure), each(self.value), each(self.node), each(self.arc), each(self.position), each(self.normal);
  }
};

/// A connected component of Gamma_c.
struct ContactPiece {
  std::string name;         ///< name of the contact; "<contact> 2" for its second component, "a + b" for contacts that touch
  std::vector<int> pairs;   ///< ids
  std::vector<int> bodies;  ///< ascending
  /// Cells between the nodes that carry pairs, by ids of the pairs: segments in the plane, triangles and quadrilaterals in space. Of a
  /// second-order side there are several.
  std::vector<std::vector<int>> cells;
  double pressureDoubt = 0.0;  ///< estimated error of nodal pressures where straight elements stand for curved sides [stress]
  std::vector<AxisPoint> onAxis;
  std::vector<int> openEnds{};  ///< ids of pairs at the rim, beyond which the boundaries go on free and without a corner

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.name), each(self.pairs), each(self.bodies), each(self.cells), each(self.pressureDoubt), each(self.onAxis);
    each(self.openEnds);
  }
};

/// Pairs beside each pair in cells, ascending. Local. \param pairs  their number, with ids from 0
std::vector<std::vector<int>> neighbourPairs(const std::vector<std::vector<int>>& cells, int pairs);

/// All that restricts the displacements of a scene: Dirichlet and bilateral rows as nodal rules, contact pairs and pieces. On rank 0, for
/// the whole mesh.
struct Constraints {
  std::vector<NodeRule> rules;             ///< at most one a node, sorted by node
  std::vector<Support> supports{};         ///< conditions behind the rules, sorted by node; none on the axis of symmetry
  std::vector<SpringDirection> springs{};  ///< directions held by elastic supports
  std::vector<std::string> conditions{};   ///< names of all boundary conditions of the scene, loads included, in its order
  std::vector<ContactPair> pairs;          ///< pairs[i].id == i
  std::vector<ContactPiece> pieces;
  ContactLaws laws{};              ///< laws of the contact lines, given by the scene (simulation/Scene); empty: frictionless
  std::vector<std::string> notes;  ///< sentences for the user about choices made
};

/// u_local = Q u for one node: row k of Q is axis k. `dimension` x `dimension`.
Matrix axesOf(const NodeRule& rule, int dimension);

}  // namespace suture
