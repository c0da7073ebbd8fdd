#pragma once
#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/answer/verdict/Verify.hpp>

namespace suture {

/// Rows of the sums at the nodes of a mesh: K u, loads, contact forces (one row per component) [force]; round-off and stiffness
/// (ElementForces).
struct NodalRows {
  int dimension = 2;

  int internal() const { return 0; }
  int applied() const { return dimension; }
  int contact() const { return 2 * dimension; }
  int rounding() const { return 3 * dimension; }
  int stiffness() const { return 3 * dimension + 1; }
  int count() const { return 3 * dimension + 2; }
};

/// Rows of the sums over rigid groups at their masters: load + contact - K u of the whole group in the motion of the master (one row per
/// component) [force]; round-off and stiffness.
struct MasterRows {
  int dimension = 2;

  int rest() const { return 0; }
  int rounding() const { return dimension; }
  int stiffness() const { return dimension + 1; }
  int count() const { return dimension + 2; }
};

/// Forces at the nodes of a scene, and the first part of their resultants.
struct NodalForces {
  std::vector<Matrix> nodes;    ///< by mesh: NodalRows x nodes, summed over subdomains
  std::vector<Matrix> masters;  ///< by mesh: MasterRows x nodes, summed over subdomains, zero except at masters; empty: no rigid groups
  bool hasRigidGroups = false;  ///< on any rank
  /// Forces of rigid obstacles (on the rank that counts a pair), elastic supports, and initial states, which are not loads.
  Balance balance;
  Reactions reactions;  ///< sums over this rank
};

/// Loops over elements, loads and pairs. Collective. \throws InputError  if an element is folded
NodalForces nodalForces(const Comm& comm, const Answer& answer, const SeamExchange& seams);

}  // namespace suture
