// Scenes loaded by another program, against the same scenes with conditions in the scene file and against known results.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/CoupledScene.hpp>
#include <suture/simulation/Simulation.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture::coupled {
namespace {

std::shared_ptr<const MaterialLaw> isotropic(double young, double poisson) {
  return std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson});
}

using Field = std::function<Point(const Point&)>;

Load along(const std::string& group, int dimension, const Field& value) {
  Load load = Load::traction(group, {0, 0, 0});
  for (int k = 0; k < dimension; ++k) load.expressions.emplace_back([=](const Point& p) { return value(p)[k]; });
  return load;
}

Point placeOf(const CouplingSurface& surface, std::size_t i) {
  Point place{0, 0, 0};
  for (int k = 0; k < surface.dimension; ++k) place[k] = surface.coordinates[i * surface.dimension + k];
  return place;
}

/// Values at the surface's nodes.
std::vector<double> at(const CouplingSurface& surface, const Field& value) {
  std::vector<double> all;
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    const Point here = value(placeOf(surface, i));
    all.insert(all.end(), here.begin(), here.begin() + surface.dimension);
  }
  return all;
}

double sumOf(const std::vector<double>& mine) {
  double sum = 0.0, all = 0.0;
  for (const double value : mine) sum += value;
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_SUM, sum, Teuchos::outArg(all));
  return all;
}

/// Largest difference of displacements over the largest displacement, over all ranks; both runs have the same partition.
template <typename One, typename Other>
double distanceBetween(const One& one, const Other& other) {
  double mine[2] = {0.0, 0.0}, all[2];
  for (std::size_t i = 0; i < one.meshes().size(); ++i) {
    const Vector &a = one.solution().displacement[i], &b = other.solution().displacement[i];
    for (Eigen::Index k = 0; k < a.size(); ++k) {
      mine[0] = std::max(mine[0], std::abs(one.meshes()[i].total(a, k) - other.meshes()[i].total(b, k)));
      mine[1] = std::max(mine[1], std::abs(other.meshes()[i].total(b, k)));
    }
  }
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_MAX, 2, mine, all);
  return all[0] / all[1];
}

int closedPairs(const Solution& solution) {
  int closed = 0;
  for (const PairResult& pair : solution.pairs) closed += pair.state.closed();
  return closed;
}

std::string complaint(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const double kYoung = 2e6, kPoisson = 0.25;

/// [0,2]x[0,1], on rollers left and below.
Scene bar(const std::vector<Load>& loads, Cell cell = Cell::Triangle3) {
  ElasticModel model;
  model.addBody("bar", isotropic(kYoung, kPoisson));
  model.loads = loads;
  return makeScene(model,
                   [cell] {
                     return boxes({{"bar", 0, 2, 0, 1, 8, 4, cell}});
                   },
                   {Condition::displacement("bar_left", {0}, {0}), Condition::displacement("bar_bottom", {0}, {1})}, {},
                   {"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-12"});
}

TEUCHOS_UNIT_TEST(Coupling, HasEveryNodeOfAGroupOnceWithItsSizeAndNormal) {
  for (const auto& [cell, nodes] : {std::pair(Cell::Triangle3, 5), {Cell::Quadrilateral9, 9}}) {
    CoupledScene simulation(blocks::world(), bar({}, cell));
    const CouplingSurface surface = simulation.surface("bar_right");
    TEST_EQUALITY(sumOf(std::vector<double>(surface.nodes.size(), 1.0)), nodes);
    TEST_FLOATING_EQUALITY(sumOf(surface.areas), 1.0, 1e-14);
    TEST_ASSERT(std::is_sorted(surface.nodes.begin(), surface.nodes.end()));
    for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
      TEST_EQUALITY(placeOf(surface, i)[0], 2.0);
      TEST_FLOATING_EQUALITY(surface.normals[2 * i], surface.areas[i], 1e-13);
      TEST_COMPARE(std::abs(surface.normals[2 * i + 1]), <, 1e-15);
    }
    TEST_EQUALITY(simulation.displacements(surface).size(), 2 * surface.nodes.size());
  }
}

// Forces of a uniform traction equal the traction times the areas, and stretch the bar as the formula predicts.
TEUCHOS_UNIT_TEST(Coupling, AUniformTractionAsNodalForcesStretchesABarAsItMust) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral9}) {
    CoupledScene simulation(blocks::world(), bar({}, cell));
    const CouplingSurface surface = simulation.surface("bar_right");
    for (const double pull : {3e4, -1e4, 5e4}) {
      std::vector<double> forces;
      for (const double area : surface.areas) forces.insert(forces.end(), {pull * area, 0.0});
      simulation.setForces(surface, forces);
      const Solution& solution = simulation.solve();
      TEST_ASSERT(simulation.ending() == ExitCode::Done);
      const std::vector<double> u = simulation.displacements(surface);
      for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
        TEST_FLOATING_EQUALITY(u[2 * i], 2.0 * (1.0 - kPoisson * kPoisson) * pull / kYoung, 1e-9);
        TEST_COMPARE(std::abs(u[2 * i + 1] + surface.coordinates[2 * i + 1] * kPoisson * (1 + kPoisson) * pull / kYoung), <, 1e-10);
      }
      const Reactions& reactions = solution.verification.reactions;
      TEST_FLOATING_EQUALITY(reactions.loads[surface.load].force[0], pull, 1e-12);
      TEST_FLOATING_EQUALITY(reactions.supports[0].force[0], -pull, 1e-9);
      TEST_FLOATING_EQUALITY(solution.extremes.vonMises.value, std::abs(pull) * std::sqrt(1.0 + kPoisson * kPoisson - kPoisson), 1e-9);
    }
  }
}

TEUCHOS_UNIT_TEST(Coupling, ALinearSceneWhoseLoadsGrowTogetherIsSolvedAlready) {
  CoupledScene simulation(blocks::world(), bar({}));
  const CouplingSurface surface = simulation.surface("bar_right");
  const auto shear = [&](double amount) { return at(surface, [=](const Point& p) { return Point{0, amount * p[1] * p[1], 0}; }); };
  simulation.setTractions(surface, shear(1e3));
  const int first = simulation.solve().auxiliary.pcg;
  TEST_COMPARE(first, >, 3);
  simulation.setTractions(surface, shear(-7e3));
  TEST_COMPARE(simulation.solve().auxiliary.pcg, <=, 2);
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  simulation.setTractions(surface, shear(0.0));  // nothing remains of the previous step
  simulation.solve();
  for (const double u : simulation.displacements(surface)) TEST_EQUALITY(u, 0.0);
}

/// A block on a longer one, held against sliding, weighed down.
Scene blocksWith(const std::vector<Load>& loads, const std::vector<std::string>& settings, bool pressed = true) {
  ElasticModel model;
  model.addBody("upper", isotropic(2e6, 0.3));
  model.addBody("lower", isotropic(1e7, 0.2));
  model.loads = {Load::bodyForce({0, -1e4, 0}, "upper")};
  model.loads.insert(model.loads.end(), loads.begin(), loads.end());
  std::vector<Condition> held{Condition::displacement("lower_bottom", {0, 0})};
  if (pressed) held.push_back(Condition::displacement("upper_left", {0}, {0}));
  std::vector<std::string> all{"Partition/METIS/Subdomains=5", "Outer Solver/Tolerance=1e-11"};
  all.insert(all.end(), settings.begin(), settings.end());
  return makeScene(
      model,
      [] {
        return boxes({{"upper", 0, 2, 0, 1, 12, 6}, {"lower", -0.5, 2.5, -1, 0, 15, 5}});
      },
      held, {Contact::between("upper_bottom", "lower_top")}, all);
}

/// Tractions that tip the block by varying amounts: pairs open and close again.
Field tipping(double amount) {
  return [amount](const Point& p) { return Point{100.0 * amount * p[0], -2e3 + amount * 3e3 * (p[0] - 1.0), 0}; };
}

TEUCHOS_UNIT_TEST(Coupling, EverySolveIsThatOfASceneWithTheseLoads) {
  for (const auto& [method, formulation] : {std::pair<std::string, std::string>{"Active Set", "Contact On The Interface"},
                                            {"Semismooth Newton", "Condensed Groups"},
                                            {"Monolithic", "Contact On The Interface"}}) {
    const std::vector<std::string> settings{"Outer Solver/Type=" + method, "Formulation=" + formulation};
    CoupledScene coupled(blocks::world(), blocksWith({}, settings));
    const CouplingSurface surface = coupled.surface("upper_top");
    std::vector<int> closed;
    for (const double amount : {0.0, 7.0, -7.0, 0.5}) {
      coupled.setTractions(surface, at(surface, tipping(amount)));
      const Solution& solution = coupled.solve(false);
      TEST_ASSERT(solution.verification.checks.empty());
      coupled.verify();
      closed.push_back(closedPairs(solution));
      TEST_ASSERT(coupled.ending() == ExitCode::Done);
      Simulation fresh(blocks::world(), blocksWith({along("upper_top", 2, tipping(amount))}, settings));
      fresh.solve();
      TEST_COMPARE(distanceBetween(coupled, fresh), <, 1e-9);
      TEST_EQUALITY(closedPairs(fresh.solution()), closed.back());
      TEST_COMPARE(std::abs(solution.energy - fresh.solution().energy), <, 1e-8 * std::abs(fresh.solution().energy));
      // integrals over [0,2] of the tractions
      const Reactions& reactions = solution.verification.reactions;
      TEST_COMPARE(std::abs(reactions.loads[surface.load].force[0] - 200.0 * amount), <, 1e-9);
      TEST_FLOATING_EQUALITY(reactions.loads[surface.load].force[1], -4e3, 1e-11);
      TEST_FLOATING_EQUALITY(reactions.supports[0].force[1], 2e4 + 4e3, 1e-8);
    }
    if (blocks::world()->getRank() == 0) {
      TEST_COMPARE(closed[1], <, closed[0]);  // it did tip
      TEST_COMPARE(closed[2], <, closed[0]);
    }
  }
}

TEUCHOS_UNIT_TEST(Coupling, MovesAHeldGroupAsAConditionDoes) {
  const Field field = [](const Point& p) { return Point{0, -0.01 + 0.004 * p[0] * p[0], 0}; };
  const auto scene = [](const Condition& condition) {
    ElasticModel model;
    model.addBody("bar", isotropic(kYoung, kPoisson));
    return makeScene(model,
                     [] {
                       return boxes({{"bar", 0, 2, 0, 1, 8, 4}});
                     },
                     {condition, Condition::displacement("bar_bottom", {0, 0})}, {},
                     {"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-12"});
  };
  CoupledScene coupled(blocks::world(), scene(Condition::displacement("bar_top", {0}, {1})));
  const CouplingSurface surface = coupled.surface("bar_top");
  for (const double factor : {1.0, -2.0}) {
    coupled.setDisplacements(surface, at(surface, [&](const Point& p) { return scaled(factor, field(p)); }));
    coupled.solve();
    TEST_ASSERT(coupled.ending() == ExitCode::Done);
    Condition moved = Condition::displacement("bar_top", {0}, {1});
    moved.data.expressions = {Expression([&](const Point& p) { return factor * field(p)[1]; })};
    Simulation fresh(blocks::world(), scene(moved));
    fresh.solve();
    TEST_COMPARE(distanceBetween(coupled, fresh), <, 1e-9);
    const std::vector<double> u = coupled.displacements(surface);
    for (std::size_t i = 0; i < surface.nodes.size(); ++i)
      TEST_FLOATING_EQUALITY(u[2 * i + 1], factor * field(placeOf(surface, i))[1], 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Coupling, In3DTractionsAreThoseOfACondition) {
  const Field field = [](const Point& p) { return Point{1e3 * p[1], -2e3 * p[0], 3e4 + 1e4 * p[0]}; };
  for (const Cell cell : {Cell::Tetrahedron4, Cell::Hexahedron20}) {
    const auto scene = [cell = cell](const std::vector<Load>& loads) {
      ElasticModel model;
      model.dimension = 3;
      model.addBody("block", isotropic(kYoung, kPoisson));
      model.loads = loads;
      Box box;
      box.name = "block";
      box.nx = box.ny = box.nz = 3;
      box.cell = cell;
      return makeScene(model, [box] { return boxes({box}); }, {Condition::displacement("block_bottom", {0, 0, 0}, {0, 1, 2})}, {},
                       {"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-12"});
    };
    CoupledScene coupled(blocks::world(), scene({}));
    Simulation fresh(blocks::world(), scene({along("block_top", 3, field)}));
    const CouplingSurface surface = coupled.surface("block_top");
    TEST_FLOATING_EQUALITY(sumOf(surface.areas), 1.0, 1e-13);
    coupled.setTractions(surface, at(surface, field));
    const Solution& solution = coupled.solve();
    fresh.solve();
    TEST_ASSERT(coupled.ending() == ExitCode::Done);
    TEST_COMPARE(distanceBetween(coupled, fresh), <, 1e-9);
    const Point& force = solution.verification.reactions.loads[surface.load].force;
    TEST_FLOATING_EQUALITY(force[0], 5e2, 1e-11);
    TEST_FLOATING_EQUALITY(force[2], 3.5e4, 1e-11);
  }
}

/// A block pressed on another one by a load on top, with friction; pushed from the right by the given condition.
const char* const rubbing = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="upper"><Parameter name="X" type="Array(double)" value="{0, 2}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{12, 6}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="X" type="Array(double)" value="{-0.5, 2.5}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{15, 5}"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Bodies">
    <ParameterList name="upper"><Parameter name="Material" type="string" value="soft"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Material" type="string" value="soft"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials"><ParameterList name="soft">
    <Parameter name="Young Modulus" type="double" value="2e6"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Pressure"/>
      <Parameter name="Value" type="Array(double)" value="{1e4}"/></ParameterList>
    <ParameterList name="push"><Parameter name="Group" type="string" value="upper_right"/><Parameter name="Type" type="string" value="Pressure"/>
      <Parameter name="Value" type="Array(double)" value="{0}"/></ParameterList>
    <ParameterList name="ground"><Parameter name="Group" type="string" value="lower_bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0, 0}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Contact"><ParameterList name="joint">
    <Parameter name="Side A" type="string" value="upper_bottom"/><Parameter name="Side B" type="string" value="lower_top"/>
    <Parameter name="Law" type="string" value="Coulomb"/><ParameterList name="Coulomb"><Parameter name="Coefficient" type="string" value="0.4"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Outer Solver"><Parameter name="Tolerance" type="double" value="1e-11"/></ParameterList>
  <ParameterList name="Partition"><ParameterList name="METIS"><Parameter name="Subdomains" type="int" value="5"/></ParameterList></ParameterList>
</ParameterList>)xml";

Scene rubbingScene(const std::vector<std::string>& settings = {}) {
  return sceneOf(parseScene(rubbing, "rubbing blocks", sceneSchema(), settings));
}

// Pushed, and released: slip remains if the push was a separate step, and does not if it was a trial of the same step.
TEUCHOS_UNIT_TEST(Coupling, WithFrictionAdvanceEndsAStep) {
  const std::string push = "Boundary Conditions/push/Value=";
  Simulation path(blocks::world(), rubbingScene({push + "{1000}", "Load Steps/Times={1, 2, 3}", "Load Steps/Factors/push={0, 6.5, 1}",
                                                 "Load Steps/Largest Change=1"}));
  Simulation once(blocks::world(), rubbingScene({push + "{1000}"}));
  CoupledScene coupled(blocks::world(), rubbingScene());
  path.solve();
  once.solve();
  TEST_ASSERT(path.ending() == ExitCode::Done && once.ending() == ExitCode::Done);
  TEST_COMPARE(distanceBetween(path, once), >, 1e-3);
  const CouplingSurface surface = coupled.surface("upper_right");
  const auto solve = [&](double pressure) {
    coupled.setTractions(surface, at(surface, [=](const Point&) { return Point{-pressure, 0, 0}; }));
    coupled.solve();
    TEST_ASSERT(coupled.ending() == ExitCode::Done);
  };
  for (const double pressure : {0.0, 6500.0, 1000.0}) solve(pressure);  // all trials of one step
  TEST_COMPARE(distanceBetween(coupled, once), <, 1e-7);
  for (const double pressure : {0.0, 6500.0, 1000.0}) {
    solve(3000.0);  // a trial, which leaves nothing behind
    solve(pressure);
    coupled.advance();
  }
  TEST_COMPARE(distanceBetween(coupled, path), <, 1e-7);
}

// Glued sides leave a linear problem whose unknowns depend on each other.
TEUCHOS_UNIT_TEST(Coupling, OfGluedBlocksBeginsOnTheWayToTheLastAnswer) {
  const std::vector<std::string> glued{"Contact/joint/Law=Tied"};
  CoupledScene coupled(blocks::world(), rubbingScene(glued));
  const CouplingSurface surface = coupled.surface("upper_right");
  for (const double pressure : {1000.0, 3000.0, -2000.0}) {
    coupled.setTractions(surface, at(surface, [=](const Point&) { return Point{-pressure, 0, 0}; }));
    coupled.solve();
    TEST_ASSERT(coupled.ending() == ExitCode::Done);
    std::vector<std::string> settings = glued;
    settings.push_back("Boundary Conditions/push/Value={" + std::to_string(pressure) + "}");
    Simulation fresh(blocks::world(), rubbingScene(settings));
    fresh.solve();
    TEST_COMPARE(distanceBetween(coupled, fresh), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(Coupling, IsRefusedTheSameOnAllRanks) {
  const auto says = [&](const std::string& text, const std::vector<std::string>& wanted) {
    for (const std::string& one : wanted) {
      if (text.find(one) == std::string::npos) out << "'" << one << "' is not in:\n" << text << "\n";
      TEST_ASSERT(text.find(one) != std::string::npos);
    }
  };
  CoupledScene simulation(blocks::world(), blocksWith({}, {})), other(blocks::world(), blocksWith({}, {}));
  says(complaint([&] { simulation.surface("uper_top"); }), {"no such side group 'uper_top'", "Did you mean 'upper_top'?"});
  const CouplingSurface surface = simulation.surface("upper_top"), ground = simulation.surface("upper_left");
  std::vector<double> forces(2 * surface.nodes.size(), 1.0);
  if (blocks::world()->getRank() == 0) forces.push_back(1.0);
  says(complaint([&] { simulation.setForces(surface, forces); }), {"coupling 'upper_top'", "values for forces; expected 2 components"});
  forces.resize(2 * surface.nodes.size());
  if (!forces.empty()) forces.back() = std::nan("");
  says(complaint([&] { simulation.setTractions(surface, forces); }), {"tractions at the node", "expected finite numbers"});
  says(complaint([&] { simulation.setDisplacements(ground, std::vector<double>(2 * ground.nodes.size(), 0.0)); }),
       {"displacements cannot be prescribed at nodes in a contact"});
  TEST_THROW(simulation.advance(), InternalError);
  TEST_THROW(simulation.verify(), InternalError);
  TEST_THROW(other.setForces(surface, std::vector<double>(surface.coordinates.size(), 0.0)), InternalError);
  TEST_THROW(simulation.summary(), InternalError);
  TEST_THROW(simulation.solution(), InternalError);
  TEST_ASSERT(simulation.ending() != ExitCode::Done);
  simulation.solve();
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  TEST_THROW(simulation.surface("upper_right"), InternalError);
  simulation.solve(false);
  TEST_ASSERT(simulation.ending() != ExitCode::Done);
  TEST_THROW(simulation.summary(), InternalError);
  says(complaint([&] { CoupledScene steps(blocks::world(), blocksWith({}, {"Load Steps/Times={1, 2}"})); }),
       {"Load Steps", "not available in a coupled scene"});
}

}  // namespace
}  // namespace suture::coupled
