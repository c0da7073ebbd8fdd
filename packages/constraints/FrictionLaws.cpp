#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/FrictionLaws.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>

namespace suture {

namespace {

/// A parameter that is a number or an expression. \throws InputError
Expression readValue(const Parameters& own, const char* name, const Constants& constants) {
  Problems problems;
  std::optional<Expression> value = readExpression(own, name, constants, problems);
  problems.throwIfAny();
  return value ? *std::move(value) : Expression("0");
}

double notNegative(const Expression& expression, const Point& place, const char* what) {
  const double value = expression.at(place);
  if (value < 0.0)
    throw InputError(what, "'" + expression.text() + "' is " + std::to_string(value) + " at (" + std::to_string(place[0]) + ", " +
                               std::to_string(place[1]) + ", " + std::to_string(place[2]) + "); expected >= 0");
  return value;
}

}  // namespace

ContactState DryFriction::doProject(const ContactTrial& trial, const ContactState& now) const {
  const Point z = plus(trial.force, trial.jump);
  if (z[0] < 0.0 || (z[0] == 0.0 && !now.closed())) return PairStatus::Open;
  ContactState state(PairStatus::Stick);
  state.bound = trial.size * notNegative(cohesion_, trial.place, "a contact's bound or cohesion");
  state.friction = notNegative(coefficient_, trial.place, "a contact's coefficient of friction");
  const double size = std::hypot(z[1], z[2]), largest = state.largest(z[0]);
  if (size < largest || size == 0.0) return state;
  state.status = PairStatus::Slip;
  state.direction = {0.0, z[1] / size, z[2] / size};
  return state;
}

Schema Tresca::schema() {
  return Schema("Tangential stress at most a given bound, whatever the pressure; no tension, no penetration.")
      .text("Bound", "0", "largest tangential stress, a number or a function of the place [stress]");
}

Tresca::Tresca(const Constants& constants, const Parameters& own) : DryFriction(readValue(own, "Bound", constants), Expression("0")) {}

Schema Coulomb::schema() {
  return Schema("Tangential stress at most cohesion + coefficient x pressure; no tension, no penetration.")
      .text("Coefficient", "0", "of friction, a number or a function of the place")
      .text("Cohesion", "0", "tangential stress that slides the sides without pressure, a number or a function of the place [stress]");
}

Coulomb::Coulomb(const Constants& constants, const Parameters& own)
    : DryFriction(readValue(own, "Cohesion", constants), readValue(own, "Coefficient", constants)) {}

}  // namespace suture
