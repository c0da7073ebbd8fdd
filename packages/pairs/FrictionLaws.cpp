#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/pairs/FrictionLaws.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <sstream>

namespace suture {

namespace {

/// Reads a parameter that is a number or an expression. \throws InputError
DryFriction::Value readValue(const Parameters& own, const char* name, const Constants& constants) {
  Problems problems;
  std::optional<Expression> value = readExpression(own, name, constants, problems);
  problems.throwIfAny();
  return {value ? *std::move(value) : Expression("0"), pathOf(own, name)};
}

}  // namespace

double DryFriction::Value::at(const Point& place) const {
  const double value = expression.at(place);
  if (value >= 0.0) return value;
  std::ostringstream text;
  text << "'" << expression.text() << "' is " << value << " at (" << place[0] << ", " << place[1] << ", " << place[2] << "); expected >= 0";
  throw InputError(path, text.str());
}

ContactState DryFriction::doProject(const ContactTrial& trial, const ContactState& now) const {
  const Point z = plus(trial.force, trial.jump);
  if (z[0] < 0.0 || (z[0] == 0.0 && !now.closed())) return PairStatus::Open;
  ContactState state(PairStatus::Stick);
  if (trial.normalOnly) return state;
  state.bound = trial.slipped && losesCohesion_ ? 0.0 : trial.size * cohesion_.at(trial.place);
  state.friction = coefficient_.at(trial.place);
  const double size = std::hypot(z[1], z[2]), largest = state.largest(z[0]);
  if (size < largest || size == 0.0) return state;
  state.status = PairStatus::Slip;
  state.direction = {0.0, z[1] / size, z[2] / size};
  return state;
}

Schema Tresca::schema() {
  return Schema("Tangential stress at most a given bound, independent of the pressure; no tension, no penetration.")
      .text("Bound", std::nullopt, "largest tangential stress, a number or a function of position [stress]");
}

Tresca::Tresca(const Constants& constants, const Parameters& own)
    : DryFriction(readValue(own, "Bound", constants), {Expression("0"), ""}) {}

Schema Coulomb::schema() {
  return Schema("Tangential stress at most cohesion + coefficient x pressure; no tension, no penetration.")
      .text("Coefficient", std::nullopt, "coefficient of friction, a number or a function of position")
      .text("Cohesion", "0", "tangential strength at zero pressure, a number or a function of position [stress]")
      .boolean("Cohesion Lost", false, "A pair that has slid in a load step has no cohesion in the following ones.");
}

Coulomb::Coulomb(const Constants& constants, const Parameters& own)
    : DryFriction(readValue(own, "Cohesion", constants), readValue(own, "Coefficient", constants),
                  own.isType<bool>("Cohesion Lost") && own.get<bool>("Cohesion Lost")) {}

}  // namespace suture
