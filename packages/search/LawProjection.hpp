#pragma once
#include <suture/pairs/ContactLaw.hpp>
#include <suture/search/FrictionCone.hpp>
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <vector>

namespace suture {

/// The laws of all pairs as one equation: forces l and jumps w satisfy the laws if l = P(l + R w), where P projects onto the forces that
/// each pair's law allows under its normal force (Alart and Curnier 1991). R is a fraction of the stiffness of each pair's nodes: .2 along
/// the normal and .05 along the tangents (a tenth of the local stiffness, which is half of the nodes'). With the full tangential stiffness
/// pairs alternate between stick and slip. Local.
class LawProjection {
 public:
  /// The first three must outlive it. \param normal  normal forces for the bounds of a Tresca problem [force]; empty: bounds follow the
  /// current normal forces
  LawProjection(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, Vector normal = {});

  /// Sets the fraction of the tangential stiffness in R.
  void setTangential(double part) { tangential_ = part; }
  /// True for a Tresca problem.
  bool isFrozen() const { return normal_.size() > 0; }

  /// True if the law of a pair restricts sliding.
  bool restrictsSliding(std::size_t pair) const { return laws_.of(rigid_.data().line[pair]).rows(2) > 1; }
  /// True if no pair that can change has a law that restricts sliding.
  bool isFrictionless() const { return frictionless_; }
  /// Tangential stiffness of both sides of a pair; zero if there is none. [force / length]
  double tangentialStiffness(std::size_t pair) const { return sites_[pair].tangential; }
  /// State of a pair at a trial force. \param now  current state;  \param force, jump  rows of the pair, the jump times R [force]
  ContactState state(std::size_t pair, const ContactState& now, const Point& force, const Point& jump) const;
  /// The given states of a Tresca problem with its own bounds.
  PairStates refrozen(PairStates states) const;
  /// States of all pairs at given forces and jumps, without tolerances. \param jump  pairs x 3 [length]
  PairStates states(const PairStates& now, const Matrix& force, const Matrix& jump) const;
  /// States of all pairs at a solution, within its tolerances: a pair in doubt keeps its current state.
  PairStates atSolution(const PairStates& now, const ContactAnswer& answer) const;
  /// Distance from the laws, sum |l - P(l + R w)|^2 / k with the stiffness k of each row [energy].
  double distance(const PairStates& now, const Matrix& force, const Matrix& jump) const;
  /// Difference between a slipping pair's tangential force and its bound in the direction of slip, relative to the force tolerance.
  double turn(std::size_t pair, const ContactState& next, const ContactAnswer& answer) const;
  /// Admissible forces of a pair for unbounded normal force; a nonlinear law is evaluated at a unit force.
  FrictionCone cone(std::size_t pair) const;

 private:
  ContactTrial trialOf(std::size_t pair) const;
  Point stiff(std::size_t pair, const Matrix& jump) const;

  const RigidBodyModel& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  double tangential_ = 0.05;
  bool frictionless_ = true;
  Vector normal_;
};

}  // namespace suture
