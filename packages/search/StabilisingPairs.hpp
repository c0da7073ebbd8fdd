#pragma once
#include <suture/search/LawProjection.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <vector>

namespace suture {

/// Adds pairs to given states until these leave no rigid motion free, so that linear problems are never singular.
///
/// In a neutral motion, neither loads nor slipping pairs do work: a ball between two plates turns about the line through its poles. A
/// spring along a tangent of an open pair holds it; the spring has no force at equilibrium, and in contrast to a tied pair it closes no
/// gap. Without friction there are no such springs, and neutral motions stay free. Other free motions are held by open or sliding pairs
/// that stick. Where their forces then exceed the laws, the search changes them like others. Local.
class StabilisingPairs {
 public:
  /// Both arguments must outlive it.
  StabilisingPairs(const RigidBodyModel& rigid, const LawProjection& projection) : rigid_(rigid), projection_(projection) {}

  /// \param next  states;  \param largest  largest force of the scene: the work of loads that balance is round-off relative to it
  /// \param inVain  pairs whose states the last solution contradicts: others are preferred
  PairStates addedTo(PairStates next, double largest, const std::vector<int>& inVain) const;

 private:
  bool isNeutral(const PairStates& next, const Matrix& free, double largest) const;
  void addSprings(PairStates& next, Matrix free) const;
  void tie(PairStates& next, Matrix free, const std::vector<int>& inVain) const;

  const RigidBodyModel& rigid_;
  const LawProjection& projection_;
};

}  // namespace suture
