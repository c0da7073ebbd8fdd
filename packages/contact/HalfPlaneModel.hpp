#pragma once
#include <suture/contact/RigidContact.hpp>

namespace suture {

/// Bodies near the ends of their contact zones as half-planes: normal displacements of a line of pairs under their forces fall with the
/// logarithm of the distance (Johnson, Contact Mechanics, 2.3). The response of a small set of pairs on both sides of each end, when
/// some of them change, is then known without a linear solve; forces farther away stay. Local.
class HalfPlaneModel {
 public:
  explicit HalfPlaneModel(const RigidContact& rigid) : rigid_(rigid) {}
  /// The closed set that the model comes to from a state of the bodies; where signs change all along a stretch of some hundred pairs, the
  /// set by these signs.
  /// \param closed, flipped      the state's, and the set by its signs alone
  /// \param force, penetration   the state's: forces of closed pairs, penetrations of open ones
  ClosedSet closedSet(const ClosedSet& closed, const ClosedSet& flipped, const Vector& force, const Vector& penetration) const;

 private:
  const RigidContact& rigid_;
};

}  // namespace suture
