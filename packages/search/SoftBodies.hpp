#pragma once
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// Rigid bodies on pads, including motions that only soft elastic supports hold. No linear problem is singular because of these motions,
/// but contact that leaves one of them to its support alone lets the body move far (a coin held sideways by a weak spring tilts by many
/// times its size), so that nearly all pairs penetrate afterwards. A search takes states from these pads instead. Local.
class SoftBodies {
 public:
  /// A support is soft if its stiffness in a motion is less than this fraction of that of all pads: pads in series with it hardly deform.
  static constexpr double kSoft = 1e-2;

  /// \param pairs    with all motions;  \param springs  stiffness of the supports in each motion, zero in free ones [force / length]
  SoftBodies(RigidBodyModel::Pairs pairs, Vector springs) : rigid_(std::move(pairs)), springs_(std::move(springs)) {}

  const RigidBodyModel::Pairs& data() const { return rigid_.data(); }
  /// True if a set leaves a motion to free space or to a soft support that all pairs together would stop.
  bool loosens(const PairStates& states) const { return rigid_.loosens(states); }
  /// Equilibrium on the pads from penetrations t. Supports act against further motion only: their present forces are small.
  /// \param compliance  of the pads [length / force];  \param reached  receives the penetrations [length]
  RigidBodyModel::Equilibrium project(const Vector& t, const Vector& compliance, Vector& reached) const;

 private:
  RigidBodyModel rigid_;
  Vector springs_;
};

}  // namespace suture
