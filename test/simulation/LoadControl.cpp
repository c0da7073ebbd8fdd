// Loads of unknown size: prescribed mean displacements and forces of bolts, against closed forms, on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Simulation.hpp>

namespace suture {
namespace {

ElasticModel modelOf(const std::vector<std::pair<std::string, double>>& bodies, double poisson) {
  ElasticModel model;
  model.plane = PlaneModel::Stress;
  for (const auto& [body, young] : bodies) model.addBody(body, std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson}));
  return model;
}

const std::vector<std::vector<std::string>> kWays{
    {"Outer Solver/Type=Monolithic"},
    {"Outer Solver/Type=Active Set"},
    {"Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton", "Preconditioner/Type=Neumann-Neumann"}};

std::vector<std::string> settingsOf(std::vector<std::string> way) {
  for (const char* more : {"Outer Solver/Tolerance=1e-11", "Partition/METIS/Subdomains=5"}) way.push_back(more);
  return way;
}

/// [0,2]x[0,1], on rollers left and below, E = 2e6.
Scene pulledBar(const Load& load, const std::vector<std::string>& way) {
  ElasticModel model = modelOf({{"bar", 2e6}}, 0.25);
  model.loads = {load};
  const auto mesh = [] { return boxes({{"bar", 0, 2, 0, 1, 8, 4}}); };
  return makeScene(model, mesh, {Condition::displacement("bar_left", {0}, {0}), Condition::displacement("bar_bottom", {0}, {1})}, {},
                   settingsOf(way));
}

TEUCHOS_UNIT_TEST(LoadControl, PullsABarByItsMeanDisplacement) {
  for (const std::vector<std::string>& way : kWays) {
    Simulation simulation(blocks::world(), pulledBar(Load::meanDisplacement("bar_right", 0, 1e-3), way));
    const Solution& solution = simulation.solve();
    out << solution.failure << "\n";
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    const Resultant& force = solution.verification.reactions.loads[0];
    TEST_FLOATING_EQUALITY(force.force[0], 2e6 * 1e-3 / 2.0, 1e-7);  // E A d / l
    TEST_COMPARE(std::abs(force.force[1]), <, 1e-9);
    TEST_FLOATING_EQUALITY(solution.extremes.vonMises.value, 1000.0, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(LoadControl, LeavesTheTargetToTheVerdict) {
  Simulation simulation(blocks::world(), pulledBar(Load::meanDisplacement("bar_right", 0, 1e-3), {}));
  const Solution& solution = simulation.solve();
  const Check& check = solution.verification.checks.back();
  TEST_EQUALITY(check.name, "controlled_loads");
  TEST_ASSERT(check.holds());
  Scene other = simulation.scene();
  other.model.loads[0].target = 2e-3;
  TEST_ASSERT(!targetCheck(*blocks::world(), other, simulation.meshes(), solution).holds());
}

TEUCHOS_UNIT_TEST(LoadControl, ReportsATargetThatNothingReaches) {
  ElasticModel model = modelOf({{"bar", 2e6}}, 0.25);
  model.loads = {Load::meanDisplacement("bar_left", 0, 1e-3)};
  Scene scene = makeScene(
      model,
      [] {
        return boxes({{"bar", 0, 2, 0, 1, 8, 4}});
      },
      {Condition::displacement("bar_bottom", {0}, {1})}, {Contact::with(Obstacle::line({0, 0, 0}, {1, 0, 0}), "bar_left")}, settingsOf({}));
  scene.laws = ContactLaws({std::make_shared<NoSeparation>()});  // holds the group
  Simulation simulation(blocks::world(), scene);
  std::string text;
  try {
    simulation.solve();
  } catch (const NumericalError& error) {
    text = error.what();
  }
  out << text << "\n";
  TEST_ASSERT(text.find("the mean displacement is") != std::string::npos && text.find("does not come near 0.001") != std::string::npos);
}

/// Two pillars, [0,1]x[2,3] and [2,3]x[2,4], on a block [0,3]x[0,2] that they press by their preloads; both end at a wall.
Scene pillars(double left, double right, const std::vector<std::string>& way) {
  ElasticModel model = modelOf({{"left", 2e5}, {"right", 1e5}, {"block", 1e5}}, 0.3);
  model.loads = {Load::preload("left", {0, 1, 0}, 1.0, -left), Load::preload("right", {0, -3, 0}, 2.0, -right)};
  const auto mesh = [] {
    std::vector<Box> all{{"left", 0, 1, 2, 3, 4, 4}, {"right", 2, 3, 2, 4, 4, 8}, {"block", 0, 3, 0, 2, 12, 8}};
    for (Box& box : all) box.cell = Cell::Quadrilateral8;
    return boxes(all);
  };
  const std::vector<Condition> held{Condition::bilateral("block_bottom"),
                                    Condition::bilateral("left_top"),
                                    Condition::bilateral("right_top"),
                                    Condition::bilateral("block_left"),
                                    Condition::displacement("left_left", {0}, {0}),
                                    Condition::displacement("right_right", {0}, {0})};
  Contact joint = Contact::between("left_bottom", "block_top");
  joint.groupsA.push_back("right_bottom");
  return makeScene(model, mesh, held, {joint}, settingsOf(way));
}

TEUCHOS_UNIT_TEST(LoadControl, GivesEachBoltItsForce) {
  for (const std::vector<std::string>& way : kWays) {
    Simulation simulation(blocks::world(), pillars(40.0, 90.0, way));
    const Solution& solution = simulation.solve();
    out << way.back() << ": " << solution.failure << "\n";
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    // The forces on the walls equal those of the pillars.
    const std::vector<Resultant>& supports = solution.verification.reactions.supports;
    TEST_FLOATING_EQUALITY(supports[1].force[1], -40.0, 1e-6);
    TEST_FLOATING_EQUALITY(supports[2].force[1], -90.0, 1e-6);
    TEST_FLOATING_EQUALITY(supports[0].force[1], 130.0, 1e-6);
  }
}

TEUCHOS_UNIT_TEST(LoadControl, ShortensABoltByItsForceOverTheSpringsInSeries) {
  ElasticModel model = modelOf({{"upper", 2e5}, {"lower", 1e5}}, 0.3);
  model.loads = {Load::preload("upper", {0, 1, 0}, 1.0, -40.0)};
  const auto mesh = [] {
    return boxes({{"upper", 0, 1, 2, 3, 4, 4, Cell::Quadrilateral8}, {"lower", 0, 1, 0, 2, 4, 8, Cell::Quadrilateral8}});
  };
  Simulation simulation(blocks::world(),
                        makeScene(model, mesh,
                                  {Condition::bilateral("lower_bottom"), Condition::bilateral("upper_top"),
                                   Condition::displacement("lower_left", {0}, {0}), Condition::displacement("upper_left", {0}, {0})},
                                  {Contact::between("upper_bottom", "lower_top")}, settingsOf({})));
  simulation.solve();
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  // 40 (l1 / E1 + l2 / E2), over the length 1
  TEST_FLOATING_EQUALITY(simulation.scene().model.loads[0].tensor[1], 40.0 * (1.0 / 2e5 + 2.0 / 1e5), 1e-7);
}

TEUCHOS_UNIT_TEST(LoadControl, ShortensOnlyTheShankOfABolt) {
  ElasticModel model = modelOf({{"bar", 1e5}}, 0.0);
  model.loads = {Load::preload("bar", {0, -5, 0}, 2.0, 40.0, Point{0.3, 2.0, 0})};  // on y = 1 to 3 of 4
  const auto mesh = [] { return boxes({{"bar", 0, 1, 0, 4, 4, 8, Cell::Quadrilateral8}}); };
  const std::vector<Condition> held{Condition::bilateral("bar_bottom"), Condition::bilateral("bar_top"), Condition::bilateral("bar_left")};
  Simulation simulation(blocks::world(), makeScene(model, mesh, held, {}, settingsOf({})));
  const Solution& solution = simulation.solve();
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  TEST_FLOATING_EQUALITY(simulation.scene().model.loads[0].tensor[1], -40.0 * 4.0 / 1e5 / 2.0, 1e-7);  // shortening F l / E, over 2
  TEST_FLOATING_EQUALITY(solution.extremes.displacement.value, 40.0 * 1.0 / 1e5, 1e-7);                // F / E over the length 1 outside
  TEST_FLOATING_EQUALITY(solution.verification.reactions.supports[0].force[1], -40.0, 1e-7);

  model.loads = {Load::preload("bar", {0, 1, 0}, 2.0, 40.0, Point{0, 9.0, 0})};
  Simulation outside(blocks::world(), makeScene(model, mesh, held, {}, settingsOf({})));
  std::string text;
  try {
    outside.solve();
  } catch (const InputError& error) {
    text = error.what();
  }
  TEST_ASSERT(text.find("contain no part of body 'bar'") != std::string::npos);
}

}  // namespace
}  // namespace suture
