#pragma once
#include <suture/constraints/ContactLaw.hpp>

namespace suture {

/// A law with a cone, a disc or both for its tangential forces: |t| <= cohesion + coefficient normal force, in space a true disc. A pair
/// sticks inside, and slips along the force on the rim. Base of Tresca's and Coulomb's laws.
class DryFriction : public ContactLaw {
 public:
  /// \param cohesion  [stress];  \param coefficient  of friction; both functions of the place, >= 0
  DryFriction(Expression cohesion, Expression coefficient) : cohesion_(std::move(cohesion)), coefficient_(std::move(coefficient)) {}

 protected:
  bool doRestrictsSliding() const override { return true; }
  ContactState doProject(const ContactTrial& trial, const ContactState& now) const override;

 private:
  Expression cohesion_, coefficient_;
};

/// Tresca's law: the tangential stress is at most `Bound`, whatever the pressure. Symmetric: a convex problem with one solution.
class Tresca : public DryFriction {
 public:
  static constexpr const char* kName = "Tresca";
  static Schema schema();
  Tresca(const Constants& constants, const Parameters& own);
};

/// Coulomb's law with cohesion: the tangential stress is at most `Cohesion` + `Coefficient` times the pressure.
class Coulomb : public DryFriction {
 public:
  static constexpr const char* kName = "Coulomb";
  static Schema schema();
  Coulomb(const Constants& constants, const Parameters& own);
};

/// Two sides glued together as they stand, whatever their meshes: no jump of displacements, any forces.
class Tied : public ContactLaw {
 public:
  static constexpr const char* kName = "Tied";

 protected:
  bool doRestrictsSliding() const override { return true; }
  bool doSeparates() const override { return false; }
  bool doIgnoresGap() const override { return true; }
  ContactState doProject(const ContactTrial&, const ContactState&) const override { return PairStatus::Stick; }
};

/// Two sides that slide freely and never part: no gap, no tangential force.
class NoSeparation : public ContactLaw {
 public:
  static constexpr const char* kName = "No Separation";

 protected:
  bool doRestrictsSliding() const override { return false; }
  bool doSeparates() const override { return false; }
  ContactState doProject(const ContactTrial&, const ContactState&) const override { return PairStatus::Slip; }
};

}  // namespace suture
