#pragma once
#include <suture/search/ContactBalance.hpp>
#include <suture/search/StabilisingPairs.hpp>

#include <vector>

namespace suture {

/// Moves bodies that states leave unconstrained along the excess of the loads over the pairs' forces, until the laws give states that hold
/// them better. Forces stay in equilibrium, because the motion is rigid. States found once are not found again. Local.
class DrivenBodies {
 public:
  /// All arguments must outlive it.
  DrivenBodies(const RigidBodyModel& rigid, const LawProjection& projection, const StabilisingPairs& stabilising)
      : rigid_(rigid), projection_(projection), stabilising_(stabilising) {}

  /// \param now, balance  states and forces of the current solution;  \param next  states that the laws give there
  /// \param largest, inVain  as in StabilisingPairs::addedTo
  /// \param found  receives states that hold the bodies
  /// \return false: no motion is driven, or only states found before would hold the bodies
  bool advance(const PairStates& now, const ContactBalance& balance, const PairStates& next, double largest, const std::vector<int>& inVain,
               PairStates& found);

 private:
  Vector motion(const ContactBalance& balance, const PairStates& next, const Matrix& free) const;

  const RigidBodyModel& rigid_;
  const LawProjection& projection_;
  const StabilisingPairs& stabilising_;
  std::vector<PairStates> met_;
};

}  // namespace suture
