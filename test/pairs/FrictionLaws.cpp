#include <Teuchos_UnitTestHarness.hpp>
#include <pairs/PairsTesting.hpp>
#include <random>
#include <support/CheckSays.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/FrictionLaws.hpp>

#include <Teuchos_ParameterList.hpp>

namespace {

using namespace pairstesting;

std::unique_ptr<ContactLaw> lawNamed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters,
                                     const Constants& constants = {}) {
  Parameters own;
  for (const auto& [parameter, value] : parameters) own.set(parameter, value);
  return Registry<ContactLaw>::instance().make(name, constants, own);
}

/// Random trials of closed pairs, in 2D and 3D, many of them near the cone.
ContactTrial randomTrial(std::mt19937& random, int dimension) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  ContactTrial trial;
  trial.size = 1.5 + value(random);
  for (int k = 0; k < dimension; ++k) trial.force[k] = value(random), trial.jump[k] = value(random);
  return trial;
}

/// Tangential force after a state's projection of a trial.
Point tangentialPart(const ContactState& state, const ContactTrial& trial) {
  Point part{0, 0, 0};
  if (!state.closed()) return part;
  const double normal = trial.force[0] + trial.jump[0];
  for (int k = 1; k <= 2; ++k)
    part[k] =
        state.status == PairStatus::Stick ? trial.force[k] + trial.jump[k] : (state.bound + state.friction * normal) * state.direction[k];
  return part;
}

// p is the projection of t onto a convex set if (t - p).(q - p) <= 0 for all q of the set, here a disc (in 2D an interval).
TEUCHOS_UNIT_TEST(FrictionLaws, StatesAreProjectionsOntoTheDisc) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  const double cohesion = 0.3, coefficient = 0.6;
  const auto law = lawNamed("Coulomb", {{"Coefficient", "0.6"}, {"Cohesion", "0.3"}});
  int slip = 0, stick = 0;
  for (int k = 0; k < 4000; ++k) {
    const int dimension = 2 + k % 2;
    const ContactTrial trial = randomTrial(random, dimension);
    const double normal = trial.force[0] + trial.jump[0];
    const ContactState state = law->project(trial, k % 3 == 0 ? PairStatus::Open : PairStatus::Slip);
    TEST_EQUALITY(state.closed(), normal > 0.0);
    if (!state.closed()) continue;
    ++(state.status == PairStatus::Stick ? stick : slip);
    const double radius = cohesion * trial.size + coefficient * normal;
    const Point p = tangentialPart(state, trial);
    TEST_COMPARE(std::hypot(p[1], p[2]), <=, radius * (1.0 + 1e-14));
    const Point t = plus(trial.force, trial.jump);
    for (int j = 0; j < 20; ++j) {
      Point q{0, radius * value(random), dimension == 3 ? radius * value(random) : 0.0};
      if (std::hypot(q[1], q[2]) > radius) continue;
      TEST_COMPARE((t[1] - p[1]) * (q[1] - p[1]) + (t[2] - p[2]) * (q[2] - p[2]), <=, 1e-13);
    }
  }
  TEST_COMPARE(std::min(slip, stick), >, 300);
}

TEUCHOS_UNIT_TEST(FrictionLaws, DoNotDependOnTheUnitOfForce) {
  std::mt19937 random(8);
  for (const double unit : {1e-30, 1e-3, 1e12, 1e30}) {
    Constants scaled{{"unit", unit}};
    const auto one = lawNamed("Coulomb", {{"Coefficient", "0.4"}, {"Cohesion", "0.2"}}),
               other = lawNamed("Coulomb", {{"Coefficient", "0.4"}, {"Cohesion", "0.2 * unit"}}, scaled);
    for (int k = 0; k < 300; ++k) {
      ContactTrial trial = randomTrial(random, 2 + k % 2);
      const ContactState before = one->project(trial, PairStatus::Stick);
      trial.force = suture::scaled(unit, trial.force);
      trial.jump = suture::scaled(unit, trial.jump);
      const ContactState after = other->project(trial, PairStatus::Stick);
      TEST_ASSERT(before.status == after.status);
      if (before.closed()) TEST_FLOATING_EQUALITY(after.bound, unit * before.bound, 1e-14);
      TEST_EQUALITY(after.friction, before.friction);
      TEST_COMPARE(norm(minus(after.direction, before.direction)), <, 1e-14);
    }
  }
}

TEUCHOS_UNIT_TEST(FrictionLaws, TakeBoundsAndCoefficientsFromExpressions) {
  ContactTrial trial;
  trial.force = {2.0, 100.0, 0.0};
  trial.place = {3.0, 0.5, 0.0};
  trial.size = 0.25;
  const auto tresca = lawNamed("Tresca", {{"Bound", "tau * (1 + x)"}}, {{"tau", 7.0}}),
             coulomb = lawNamed("Coulomb", {{"Coefficient", "y"}, {"Cohesion", "x^2"}});
  const ContactState bounded = tresca->project(trial, {}), frictional = coulomb->project(trial, {});
  TEST_FLOATING_EQUALITY(bounded.largest(2.0), 0.25 * 28.0, 1e-15);
  TEST_FLOATING_EQUALITY(bounded.largest(1e6), 0.25 * 28.0, 1e-15);  // for any pressure
  TEST_ASSERT(!bounded.couplesToNormal());
  TEST_FLOATING_EQUALITY(frictional.largest(2.0), 0.25 * 9.0 + 0.5 * 2.0, 1e-15);
  TEST_FLOATING_EQUALITY(frictional.largest(-2.0), 0.25 * 9.0, 1e-15);
  TEST_ASSERT(frictional.couplesToNormal());
  for (const auto* law : {tresca.get(), coulomb.get()})
    for (const int dimension : {2, 3}) TEST_EQUALITY(law->rows(dimension), dimension);
}

TEUCHOS_UNIT_TEST(FrictionLaws, RefuseNegativeCoefficientsAndBounds) {
  ContactTrial trial;
  trial.force[0] = trial.size = 1.0;
  trial.place = {-2.0, 0.0, 0.0};
  const std::pair<const char*, std::vector<std::pair<std::string, std::string>>> wrong[] = {
      {"Tresca", {{"Bound", "3 * x"}}}, {"Coulomb", {{"Coefficient", "3 * x"}}}, {"Coulomb", {{"Cohesion", "3 * x"}}}};
  for (const auto& [name, parameters] : wrong) {
    const auto law = lawNamed(name, parameters);
    trial.place[0] = 2.0;
    TEST_NOTHROW(law->project(trial, {}));
    trial.place[0] = -2.0;
    try {
      law->project(trial, {});
      TEST_ASSERT(false);
    } catch (const InputError& error) {
      SUTURE_CHECK_SAYS(error.what(), "3 * x");
      SUTURE_CHECK_SAYS(error.what(), "-6");
      SUTURE_CHECK_SAYS(error.what(), "(-2");
    }
  }
  TEST_THROW(lawNamed("Coulomb", {{"Coefficient", "mu"}}), InputError);
}

// The bound may be a function of place that only the contact can evaluate; it is not needed for the normal direction.
TEUCHOS_UNIT_TEST(FrictionLaws, NeedNoBoundForTheNormalDirection) {
  const auto law = lawNamed("Coulomb", {{"Coefficient", "sqrt(x - 1)"}});
  TEST_ASSERT(law->pressed().status == PairStatus::Stick);
  ContactTrial trial;
  trial.force = {1.0, 0.5, 0.0};
  trial.size = 2.0;
  trial.normalOnly = true;
  TEST_ASSERT(law->project(trial, {}).closed());
  trial.normalOnly = false;
  TEST_THROW(law->project(trial, {}), InputError);
  trial.place[0] = 1.16;
  TEST_FLOATING_EQUALITY(law->project(trial, {}).friction, 0.4, 1e-14);
}

// A zero bound holds nothing: a pair with any tangential trial force slips, in its direction, without force.
TEUCHOS_UNIT_TEST(FrictionLaws, WithoutABoundEveryPushSlides) {
  const auto law = lawNamed("Coulomb", {});
  ContactTrial trial;
  trial.force[0] = trial.size = 1.0;
  trial.jump = {0, 3e-9, -4e-9};
  const ContactState state = law->project(trial, PairStatus::Stick);
  TEST_ASSERT(state.status == PairStatus::Slip);
  TEST_FLOATING_EQUALITY(state.direction[1], 0.6, 1e-14);
  TEST_FLOATING_EQUALITY(state.direction[2], -0.8, 1e-14);
  TEST_EQUALITY(state.largest(1.0), 0.0);
}

TEUCHOS_UNIT_TEST(FrictionLaws, TiedPairsStickAndGuidedOnesSlideUnderAnyForce) {
  std::mt19937 random(9);
  const Tied tied;
  const NoSeparation guided;
  for (int k = 0; k < 100; ++k) {
    const ContactTrial trial = randomTrial(random, 2 + k % 2);
    for (const PairStatus now : {PairStatus::Open, PairStatus::Slip, PairStatus::Stick}) {
      TEST_ASSERT(tied.project(trial, now) == ContactState(PairStatus::Stick));
      TEST_ASSERT(guided.project(trial, now) == ContactState(PairStatus::Slip));
    }
  }
  for (const int dimension : {2, 3}) {
    TEST_EQUALITY(tied.rows(dimension), dimension);
    TEST_EQUALITY(guided.rows(dimension), 1);
  }
  TEST_ASSERT(!tied.separates() && !guided.separates());
  TEST_ASSERT(tied.ignoresGap() && !guided.ignoresGap());
}

TEUCHOS_UNIT_TEST(FrictionLaws, CohesionIsLostWhereAPairHasSlidIfAsked) {
  Parameters own;
  own.set("Coefficient", std::string("0.5")), own.set("Cohesion", std::string("0.25"));
  for (const bool loses : {false, true}) {
    own.set("Cohesion Lost", loses);
    const auto law = Registry<ContactLaw>::instance().make("Coulomb", Constants(), own);
    ContactTrial trial;
    trial.force = {1.0, 3.0, 0.0};
    trial.size = 2.0;
    for (const bool slipped : {false, true}) {
      trial.slipped = slipped;
      const ContactState state = law->project(trial, PairStatus::Stick);
      TEST_EQUALITY(state.bound, loses && slipped ? 0.0 : 0.5);
      TEST_EQUALITY(state.friction, 0.5);
    }
  }
}

}  // namespace
