#pragma once
#include <suture/constraints/Constraints.hpp>

namespace suture {

/// Resultants of a whole scene, gathered node by node: loads, and forces of prescribed displacements and rigid obstacles.
class Balance {
 public:
  Point applied{0, 0, 0};    ///< sum of the loads [force]; x of axisymmetric scenes: sum of magnitudes around the circle
  Point reactions{0, 0, 0};  ///< sum of the forces of prescribed displacements, elastic supports and rigid obstacles [force]
  double imbalance = 0.0;    ///< |applied + reactions| (axisymmetric: along the axis) over half of the sum of force magnitudes

  /// Adds one node; call once per node. \param load  at the node;  \param support  internal minus external and contact forces, whose
  /// prescribed components are reactions;  \param rule  of the node, or null  \param isRigid  the node is in a rigid group, whose reaction
  /// is the sum of all components
  void addNode(const Point& load, const Point& support, const NodeRule* rule, int dimension, bool isRigid = false);
  /// Forces of elastic supports on the nodes of a mesh. \param forces  node-major, Cartesian; may be empty
  void addSupports(const Vector& forces, int dimension);
  /// Subtracts a part of the loads that does not count as a load, such as nodal forces of initial stresses.
  void leaveOut(const Point& load);
  /// Adds one pair; call once per pair. \param onB  its whole contact force on side B
  void addPair(const ContactPair& pair, const Point& onB);
  /// Sums over ranks, and sets `imbalance`. Collective.
  void finish(const Comm& comm, bool axisymmetric);
  /// The same for a single rank. Local.
  void finish(bool axisymmetric);

 private:
  double absolute_ = 0.0;
};

}  // namespace suture
