#pragma once
#include <suture/contact/FrictionCone.hpp>
#include <suture/contact/FrictionSearch.hpp>

#include <vector>

namespace suture {

/// The laws of all pairs as one equation: forces l and jumps w satisfy them where l = P(l + R w), P the projection onto the forces that the
/// law of each pair allows under its normal force (Alart and Curnier 1991). R is a part of the stiffness of each pair's nodes: .2 along the
/// normal, .05 along the tangents (a tenth of the local stiffness, which is half of the nodes'): with all of it pairs alternate between
/// stick and slip. Local.
class LawProjection {
 public:
  /// All must outlive it.
  LawProjection(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites)
      : rigid_(rigid), laws_(laws), sites_(sites) {}

  /// Takes `part` of the tangential stiffness in R.
  void setTangential(double part) { tangential_ = part; }
  /// Takes bounds of given normal forces [force] in place of those of the laws: a Tresca problem. Empty: the laws' own.
  void freeze(const Vector& normal) { normal_ = normal; }
  bool isFrozen() const { return normal_.size() > 0; }

  /// True if the law of a pair restricts sliding.
  bool rubs(std::size_t pair) const { return laws_.of(rigid_.data().line[pair]).rows(2) > 1; }
  /// Stiffness of both sides of a pair along the tangents; zero where there is none. [force / length]
  double tangentialStiffness(std::size_t pair) const { return sites_[pair].tangential; }
  /// State of a pair at a trial force. \param now  the state that it has;  \param force, jump  rows of the pair, the jump times R [force]
  ContactState state(std::size_t pair, const ContactState& now, const Point& force, const Point& jump) const;
  /// States of all pairs at forces and jumps, as they stand. \param jump  pairs x 3 [length]
  PairStates states(const PairStates& now, const Matrix& force, const Matrix& jump) const;
  /// States of all pairs at an answer, which is believed as far as its tolerances say: a pair in doubt keeps the state that it has.
  PairStates believed(const PairStates& now, const FrictionAnswer& answer) const;
  /// Distance from the laws, sum |l - P(l + R w)|^2 / k with the stiffness k of each row [energy].
  double distance(const PairStates& now, const Matrix& force, const Matrix& jump) const;
  /// Deviation of the force of a pair that slips from the direction of its slip, in parts of the force's tolerance.
  double turn(std::size_t pair, const ContactState& next, const FrictionAnswer& answer) const;
  /// Forces that a pair can have, normal ones up to infinity; a law that is not linear is asked at a unit force.
  FrictionCone cone(std::size_t pair) const;

 private:
  ContactTrial trialOf(std::size_t pair) const;
  Point stiff(std::size_t pair, const Matrix& jump) const;

  const RigidContact& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  double tangential_ = 0.05;
  Vector normal_;
};

}  // namespace suture
