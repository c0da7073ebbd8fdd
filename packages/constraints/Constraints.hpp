#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/constraints/ContactState.hpp>
#include <suture/pairing/ContactPair.hpp>

#include <array>
#include <string>
#include <vector>

namespace suture {

struct Mesh;

/// A node whose displacement components are not simply the Cartesian ones, all free: prescribed values and axes.
/// The local component k of the displacement u is axes[k] . u ; a fixed one has the given value. Axes are orthonormal.
struct NodeRule {
  int node = -1;
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<bool, 3> fixed{{false, false, false}};
  Point value{0, 0, 0};  ///< values of the fixed components [length]

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.node), each(self.axes), each(self.fixed), each(self.value);
  }
};

/// Part of the values of a node's rule that one factor of the load steps multiplies.
struct RuleValue {
  int node = -1;
  Point value{0, 0, 0};  ///< as NodeRule::value [length]

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.node), each(self.value);
  }
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

/// Decision of a solver about a pair; its gap and pressure follow from the displacements.
struct PairForce {
  int id = -1;
  ContactState state;
  double force = 0.0;         ///< > 0 compressive [force]
  Point tangential{0, 0, 0};  ///< that side B feels of the sliding of A, Cartesian [force]
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

/// All that restricts the displacements of a scene: Dirichlet and bilateral rows as nodal rules, contact pairs and pieces. On rank 0, for
/// the whole mesh.
struct Constraints {
  std::vector<NodeRule> rules;  ///< at most one a node, sorted by node
  /// Parts of the rules' values by factor of LoadSteps, those that are not zero, sorted by node; empty: nothing multiplies them.
  std::vector<std::vector<RuleValue>> prescribed{};
  std::vector<Support> supports{};         ///< conditions behind the rules, sorted by node; none on the axis of symmetry
  std::vector<SpringDirection> springs{};  ///< directions held by elastic supports
  std::vector<std::string> conditions{};   ///< names of all boundary conditions of the scene, loads included, in its order
  std::vector<ContactPair> pairs;          ///< pairs[i].id == i
  std::vector<ContactPiece> pieces;
  ContactLaws laws{};              ///< laws of the contact lines, given by the scene (simulation/Scene); empty: frictionless
  std::vector<std::string> notes;  ///< sentences for the user about choices made
};

/// Gives the constraints their laws. Pairs of a law that takes the sides as they stand have no gap; those of a law that restricts sliding
/// are told where nothing slides (ContactPair::still).
void applyLaws(const ContactLaws& laws, const Mesh& mesh, Constraints& constraints);

/// u_local = Q u for one node: row k of Q is axis k. `dimension` x `dimension`.
Matrix axesOf(const NodeRule& rule, int dimension);

}  // namespace suture
