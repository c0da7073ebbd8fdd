#pragma once
#include <suture/constraints/Constraints.hpp>

namespace suture {

/// Resultants of a whole scene, gathered node by node: loads against the forces of prescribed displacements and rigid obstacles.
class Balance {
 public:
  Point applied{0, 0, 0};    ///< sum of the loads [force]; x of axisymmetric scenes: of magnitudes round the circle
  Point reactions{0, 0, 0};  ///< sum of the forces of prescribed displacements, elastic supports and rigid obstacles [force]
  double imbalance = 0.0;    ///< |applied + reactions| (axisymmetric: along the axis) over half of the sum of the forces' magnitudes

  /// One node of the mesh, once. \param load  on it;  \param support  internal less external and contact forces, of which the prescribed
  /// components are reactions;  \param rule  of the node, or null
  void addNode(const Point& load, const Point& support, const NodeRule* rule, int dimension);
  /// Forces of elastic supports on the nodes of a mesh. \param forces  node-major, Cartesian; may be empty
  void addSupports(const Vector& forces, int dimension);
  /// A part of the loads that is none, as the nodal forces of initial stresses.
  void leaveOut(const Point& load);
  /// One pair, once. \param onB  its whole contact force on side B
  void addPair(const ContactPair& pair, const Point& onB);
  /// Sums over ranks, and sets `imbalance`. Collective.
  void finish(const Comm& comm, bool axisymmetric);
  /// The same of one rank alone. Local.
  void finish(bool axisymmetric);

 private:
  double absolute_ = 0.0;
};

}  // namespace suture
