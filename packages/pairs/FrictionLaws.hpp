#pragma once
#include <suture/pairs/ContactLaw.hpp>

namespace suture {

/// Law with a cone, a disc or both for its tangential forces: |t| <= cohesion + coefficient normal force, in 3D a true disc. A pair
/// sticks in the interior, and slips along the force on the boundary. Base class of Tresca and Coulomb.
class DryFriction : public ContactLaw {
 public:
  /// Function of position that must not be negative, and the parameter that it comes from.
  struct Value {
    Expression expression;
    std::string path = {};
    double at(const Point& place) const;  ///< \throws InputError  if it is negative there
  };
  /// \param cohesion  [stress];  \param coefficient  of friction;  \param losesCohesion  after a pair has slid in a load step
  DryFriction(Value cohesion, Value coefficient, bool losesCohesion = false)
      : cohesion_(std::move(cohesion)), coefficient_(std::move(coefficient)), losesCohesion_(losesCohesion) {}
  DryFriction(Expression cohesion, Expression coefficient) : DryFriction(Value{std::move(cohesion)}, Value{std::move(coefficient)}) {}

 protected:
  bool doRestrictsSliding() const override { return true; }
  ContactState doProject(const ContactTrial& trial, const ContactState& now) const override;

 private:
  Value cohesion_, coefficient_;
  bool losesCohesion_ = false;
};

/// Tresca's law: where the sides touch, the tangential stress is at most `Bound`, independent of the pressure. As long as no pair opens or
/// closes, the problem is convex and has one solution; a pair that opens loses its bound at once, and there may be no solution.
class Tresca : public DryFriction {
 public:
  static constexpr const char* kName = "Tresca";
  static Schema schema();
  Tresca(const Constants& constants, const Parameters& own);
};

/// Coulomb's law with cohesion: the tangential stress is at most `Cohesion` + `Coefficient` times the pressure. With `Cohesion Lost`, a
/// pair that has slid in a load step has no cohesion in the following ones.
class Coulomb : public DryFriction {
 public:
  static constexpr const char* kName = "Coulomb";
  static Schema schema();
  Coulomb(const Constants& constants, const Parameters& own);
};

/// Two sides glued in their drawn position, also with non-matching meshes: no jump of displacements, arbitrary forces.
class Tied : public ContactLaw {
 public:
  static constexpr const char* kName = "Tied";

 protected:
  bool doRestrictsSliding() const override { return true; }
  bool doSeparates() const override { return false; }
  bool doIgnoresGap() const override { return true; }
  ContactState doProject(const ContactTrial&, const ContactState&) const override { return PairStatus::Stick; }
};

/// Two sides that slide freely and never separate: no gap, no tangential force.
class NoSeparation : public ContactLaw {
 public:
  static constexpr const char* kName = "No Separation";

 protected:
  bool doRestrictsSliding() const override { return false; }
  bool doSeparates() const override { return false; }
  ContactState doProject(const ContactTrial&, const ContactState&) const override { return PairStatus::Slip; }
};

}  // namespace suture
