#pragma once
#include <suture/pairs/ContactLaw.hpp>
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <functional>

namespace suture {

/// Limit analysis of an elastic scene with friction: bodies slide as a whole along closed pairs, without opening or closing any.
///
/// Rigid-body statics does not bound the normal forces of a press fit, because its pressure is elastic. Along a motion m that leaves all
/// normal gaps unchanged, the loads do the work e.m, and friction dissipates at most sum bound(N) |t m| for the normal forces N of the
/// scene. The multiple s of friction at which both are equal is found together with N, by linear problems in which all pairs slip along m
/// under s times their friction. The result is a limit equilibrium; s > 1 means that the actual friction does not hold the loads.
class Collapse {
 public:
  /// All arguments must outlive it.
  Collapse(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, LinearContactSolver& solver)
      : rigid_(rigid), laws_(laws), sites_(sites), solver_(solver) {}

  struct Result {
    Vector motion;          ///< direction in which bodies slide, of unit length; empty: no mechanism with a multiple above one was found
    double multiple = 0.0;  ///< factor on friction at which friction just holds the loads
    int solves = 0;
  };
  static constexpr int kSolves = 10;  ///< usual maximum number of solves
  /// \param states  states of the pairs; only the closed pairs are used
  /// \param normal  normal forces of the pairs, as initial guess
  /// \param most  maximum number of solves
  /// Collective if the solver is.
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

  const RigidBodyModel& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  LinearContactSolver& solver_;
};

}  // namespace suture
