#pragma once
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// Half-plane model of bodies near the ends of their contact zones: normal displacements of a line of pairs under their forces decrease
/// with the logarithm of the distance (Johnson, Contact Mechanics, 2.3). It predicts, without a linear solve, how a small set of pairs on
/// both sides of each end responds if some of them change; forces farther away are kept. Local.
class HalfPlaneModel {
 public:
  explicit HalfPlaneModel(const RigidBodyModel& rigid) : rigid_(rigid) {}
  /// Predicted closed set, starting from a state of the bodies. Where the signs of some hundred adjacent pairs change, the set given by the
  /// signs is used.
  /// \param closed, flipped      the set of the state, and the set given by the signs of its forces and penetrations
  /// \param force, penetration   of the state: forces of closed pairs, penetrations of open ones
  ClosedSet closedSet(const ClosedSet& closed, const ClosedSet& flipped, const Vector& force, const Vector& penetration) const;

 private:
  const RigidBodyModel& rigid_;
};

}  // namespace suture
