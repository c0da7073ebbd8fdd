#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/constraints/RigidGroup.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactPiece.hpp>

#include <array>
#include <string>
#include <vector>

namespace suture {

struct Mesh;

/// Prescribed values and axes of a node whose displacement components are not all Cartesian and free.
/// The local component k of the displacement u is axes[k] . u ; a fixed component has the given value, in a rigid group (RigidGroup) that
/// value plus a combination of the masters. Axes are orthonormal.
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

/// Share of a boundary condition in the force that holds a node: along . force, in its direction. The shares of a node sum to the force
/// along the fixed axes of its rule. Conditions that prescribe the same direction have equal shares; a condition whose direction the others
/// already hold has none.
struct Support {
  int node = -1;
  int condition = -1;  ///< index in Constraints::conditions
  Point direction{0, 0, 0}, along{0, 0, 0};
  bool atPoint = false;  ///< the condition holds this node alone (Condition::point): stresses are unbounded there

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.node), each(self.condition), each(self.direction), each(self.along), each(self.atPoint);
  }
};

/// Direction along which an elastic support resists a node of an element's side. It holds the rigid-body motions that move it.
struct SpringDirection {
  int element = -1, node = -1;
  Point direction{0, 0, 0};
};

/// All constraints on the displacements of a scene: Dirichlet and bilateral rows as nodal rules, contact pairs and pieces. On rank 0, for
/// the whole mesh.
struct Constraints {
  std::vector<NodeRule> rules;  ///< at most one per node, sorted by node
  /// Nonzero parts of the rules' values by factor of LoadSteps, sorted by node; empty: no factor multiplies them.
  std::vector<std::vector<RuleValue>> prescribed{};
  std::vector<Support> supports{};         ///< conditions behind the rules, sorted by node; none on the axis of symmetry
  std::vector<SpringDirection> springs{};  ///< directions held by elastic supports
  std::vector<std::string> conditions{};   ///< names of all boundary conditions of the scene, loads included, in its order
  std::vector<ContactPair> pairs;          ///< pairs[i].id == i
  std::vector<ContactPiece> pieces;
  ContactLaws laws{};              ///< laws of the contact lines, set by the scene (simulation/Scene); empty: frictionless
  std::vector<std::string> notes;  ///< sentences for the user about choices made
  std::vector<RigidGroup> rigidGroups{};
  BoundaryParts parts{};
};

/// Sets the laws of the constraints. Pairs of a law that ignores the gap have none; pairs of a law that restricts sliding get the
/// directions without sliding (ContactPair::still).
void applyLaws(const ContactLaws& laws, const Mesh& mesh, Constraints& constraints);
/// The same if the values of the rules do not say how the sides have moved against each other. \param rules  with values that say it
void applyLaws(const ContactLaws& laws, const Mesh& mesh, const std::vector<NodeRule>& rules, Constraints& constraints);

/// u_local = Q u for one node: row k of Q is axis k. `dimension` x `dimension`.
Matrix axesOf(const NodeRule& rule, int dimension);

}  // namespace suture
