#pragma once
#include <suture/contact/FrictionSearch.hpp>

#include <functional>

namespace suture {

/// Limit analysis of an elastic scene with friction: bodies that slide as a whole along closed pairs, without opening or closing any.
///
/// Statics of rigid bodies bounds no normal force of a press fit: its pressure is elastic. Along a motion m that leaves all normal gaps as
/// they are, the loads do the work e.m, and friction takes at most  sum bound(N) |t m|  with the normal forces N of the scene. The multiple
/// s of friction at which both are equal is found together with N: by linear problems in which all pairs slip along m under s times their
/// friction. That is an equilibrium at its limit; s > 1 says that friction as it is does not hold the loads.
class Collapse {
 public:
  /// All must outlive it.
  Collapse(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle)
      : rigid_(rigid), laws_(laws), sites_(sites), oracle_(oracle) {}

  struct Result {
    Vector motion;          ///< along which bodies slide, of unit length; empty: no mechanism with a multiple above one was found
    double multiple = 0.0;  ///< factor on friction at which it just holds the loads
    int solves = 0;
  };
  /// \param states  of the pairs, from which those that are closed are taken;  \param normal  their normal forces, as a start
  /// \param most  solves at most. Collective where the oracle is.
  Result find(const PairStates& states, Vector normal, int most) const;

 private:
  ContactState slipping(std::size_t pair, const Vector& slip, double normal, double multiple) const;
  Matrix mechanisms(const ClosedSet& closed) const;
  double bound(std::size_t pair, const Vector& slip, double normal) const;
  double resistance(const ClosedSet& closed, const Vector& normal, const Vector& motion) const;
  Vector steepest(const ClosedSet& closed, const Vector& normal, const Matrix& mechanisms) const;
  bool meetsOthers(const ClosedSet& closed, const Vector& motion) const;
  PairStates sliding(const ClosedSet& closed, const Vector& normal, const Vector& motion, double multiple, const PairStates& now) const;
  Vector slipOf(std::size_t pair, const Vector& motion) const;

  const RigidContact& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  FrictionOracle& oracle_;
};

}  // namespace suture
