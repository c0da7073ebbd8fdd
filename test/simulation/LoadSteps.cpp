// Paths of load steps against scenes solved in one step, and against known results.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/LoadPath.hpp>
#include <suture/simulation/Simulation.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {
namespace {

/// A block on another one, pressed by the given sides, moved along x on top. Gaps and friction as in the settings.
const char* const twoBlocks = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="upper"><Parameter name="X" type="Array(double)" value="{0, 2}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{12, 6}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="X" type="Array(double)" value="{-0.5, 2.5}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{15, 5}"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Bodies">
    <ParameterList name="upper"><Parameter name="Material" type="string" value="soft"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Material" type="string" value="stiff"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="soft"><Parameter name="Young Modulus" type="double" value="2e6"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList>
    <ParameterList name="stiff"><Parameter name="Young Modulus" type="double" value="1e7"/><Parameter name="Poisson Ratio" type="double" value="0.2"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="side"><Parameter name="Group" type="string" value="upper_right"/><Parameter name="Type" type="string" value="Pressure"/>
      <Parameter name="Expression" type="string" value="1e4*(1 + y)"/></ParameterList>
    <ParameterList name="ground"><Parameter name="Group" type="string" value="lower_bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0, 0}"/></ParameterList>
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Components" type="string" value="y"/><Parameter name="Expression y" type="string" value="-0.02 + 0.005*x"/></ParameterList>
    <ParameterList name="push"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Components" type="string" value="x"/><Parameter name="Value" type="Array(double)" value="{0.01}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Contact"><ParameterList name="joint">
    <Parameter name="Side A" type="string" value="upper_bottom"/><Parameter name="Side B" type="string" value="lower_top"/>
    <Parameter name="Coupling" type="string" value="Mortar"/>
  </ParameterList></ParameterList>
  <ParameterList name="Outer Solver"><Parameter name="Tolerance" type="double" value="1e-11"/></ParameterList>
  <ParameterList name="Partition"><ParameterList name="METIS"><Parameter name="Subdomains" type="int" value="5"/></ParameterList></ParameterList>
</ParameterList>)xml";

Scene sceneWith(const std::vector<std::string>& settings) { return sceneOf(parseScene(twoBlocks, "two blocks", sceneSchema(), settings)); }

const std::vector<std::string> frictional{"Contact/joint/Law=Coulomb", "Contact/joint/Coulomb/Coefficient=0.3"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// A quiet run in a separate folder.
struct Path {
  Simulation simulation;
  explicit Path(const std::vector<std::string>& settings) : simulation(blocks::world(), sceneWith(settings)) {}
  const Solution& solve(const std::string& restart = "") { return simulation.solve(restart); }
};

/// Largest difference of displacements over the largest displacement, over all ranks; both runs have the same partition. Without friction
/// and load steps, displacements are relative to rigid motions that were taken out.
double distanceBetween(const Path& one, const Path& other) {
  double mine[2] = {0.0, 0.0}, all[2];
  for (std::size_t i = 0; i < one.simulation.meshes().size(); ++i) {
    const Vector &a = one.simulation.solution().displacement[i], &b = other.simulation.solution().displacement[i];
    for (Eigen::Index k = 0; k < a.size(); ++k) {
      const double here = one.simulation.meshes()[i].total(a, k), there = other.simulation.meshes()[i].total(b, k);
      mine[0] = std::max(mine[0], std::abs(here - there));
      mine[1] = std::max(mine[1], std::abs(there));
    }
  }
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_MAX, 2, mine, all);
  return all[0] / all[1];
}

// Without friction the order of loads does not matter: the path ends at the solution of the scene with its final loads, with everything
// reused.
TEUCHOS_UNIT_TEST(LoadSteps, APathWithoutFrictionEndsWhereTheSceneAloneIs) {
  const std::vector<std::string> factors{"Load Steps/Times={1, 2, 3}", "Load Steps/Factors/press={0.2, 1.5, 0.5}",
                                         "Load Steps/Factors/push=2 - t", "Load Steps/Factors/side={0, 1, -0.5}"};
  const std::vector<std::string> ending{"Boundary Conditions/press/Expression y=0.5*(-0.02 + 0.005*x)",
                                        "Boundary Conditions/push/Value={-0.01}", "Boundary Conditions/side/Expression=-0.5*1e4*(1 + y)"};
  for (const auto& [method, formulation] : {std::pair<std::string, std::string>{"Active Set", "Contact On The Interface"},
                                            {"Semismooth Newton", "Condensed Groups"},
                                            {"Monolithic", "Contact On The Interface"}}) {
    const std::vector<std::string> settings{"Outer Solver/Type=" + method, "Formulation=" + formulation};
    Path path(with(settings, factors)), alone(with(settings, ending));
    const Solution &a = path.solve(), &b = alone.solve();
    TEST_ASSERT(path.simulation.ending() == ExitCode::Done && alone.simulation.ending() == ExitCode::Done);
    TEST_COMPARE(distanceBetween(path, alone), <, 1e-9);
    TEST_COMPARE(std::abs(a.energy - b.energy), <, 1e-8 * std::abs(b.energy));
  }
}

TEUCHOS_UNIT_TEST(LoadSteps, AStepWithFrictionIsTheSceneOfOneStep) {
  Path path(with(frictional, {"Load Steps/Times={1}"})), alone(frictional);
  path.solve();
  alone.solve();
  TEST_ASSERT(path.simulation.ending() == ExitCode::Done);
  TEST_COMPARE(distanceBetween(path, alone), <, 1e-9);
}

// While all pairs stick, displacements change like the loads: a step begins at its solution, and only verifies it.
TEUCHOS_UNIT_TEST(LoadSteps, StepsBeginWhereTheLastOneLeads) {
  const std::vector<std::string> sticking{"Contact/joint/Law=Coulomb", "Contact/joint/Coulomb/Coefficient=5",
                                          "Boundary Conditions/side/Expression=0*x", "Load Steps/Factors/push=0.1*t"};
  Path two(with(sticking, {"Load Steps/Times={1, 2}"})), six(with(sticking, {"Load Steps/Times={1, 2, 3, 4, 5, 6}"}));
  const int first = two.solve().pcgTotal, all = six.solve().pcgTotal;
  TEST_ASSERT(two.simulation.ending() == ExitCode::Done && six.simulation.ending() == ExitCode::Done);
  out << first << " applications for two steps, " << all << " for six\n";
  TEST_COMPARE(all - first, <=, 4 * 5);  // an iteration takes one, a step from its old place 20 to 30
}

// Pressed, pushed and pushed back: by the interface and by the reference, which keep histories in different ways.
TEUCHOS_UNIT_TEST(LoadSteps, APathWithFrictionIsTheReferencesPath) {
  const std::vector<std::string> back =
      with(frictional, {"Load Steps/Times={1, 2, 3, 4}", "Load Steps/Factors/press=min(t, 1)", "Load Steps/Factors/push={0, 1, 0.3, -0.5}",
                        "Load Steps/Factors/side={0, 0, 0.5, 0}", "Load Steps/Largest Change=1"});
  Path path(back), reference(with(back, {"Outer Solver/Type=Monolithic"})),
      alone(with(frictional, {"Boundary Conditions/push/Value={-0.005}", "Boundary Conditions/side/Expression=0*x"}));
  const Solution& a = path.solve();
  reference.solve();
  alone.solve();
  TEST_ASSERT(path.simulation.ending() == ExitCode::Done && reference.simulation.ending() == ExitCode::Done);
  TEST_COMPARE(distanceBetween(path, reference), <, 1e-8);
  TEST_COMPARE(distanceBetween(path, alone), >, 1e-3);  // the path matters
  double mine = 0.0;
  for (const PairResult& pair : a.pairs) {
    mine += pair.dissipated;
    TEST_COMPARE(pair.dissipated, >=, 0.0);
  }
  if (blocks::world()->getRank() == 0) TEST_COMPARE(mine, >, 0.0);
}

// A run that ends at time 2, and one that continues from its checkpoint to 4, equal to an uninterrupted run.
TEUCHOS_UNIT_TEST(LoadSteps, APathGoesOnFromItsCheckpoint) {
  const std::string ranks = std::to_string(blocks::world()->getSize()), folder = "load_steps_" + ranks;
  const std::vector<std::string> back =
      with(frictional, {"Load Steps/Factors/press=min(t, 1)", "Load Steps/Factors/push=sin(t)", "Contact/joint/Coulomb/Cohesion=1e3",
                        "Contact/joint/Coulomb/Cohesion Lost=true"});
  Path whole(with(back, {"Load Steps/Times={1, 2, 3, 4}"})), first(with(back, {"Load Steps/Times={1, 2}"})),
      second(with(back, {"Load Steps/Times={1, 2, 3, 4}"}));
  const Solution& expected = whole.solve();
  first.simulation.writeInto(folder);
  first.solve();
  TEST_ASSERT(first.simulation.report().code == ExitCode::Done);
  const Solution& found = second.solve(folder + "/checkpoint.h5");
  TEST_ASSERT(second.simulation.ending() == ExitCode::Done);
  TEST_COMPARE(distanceBetween(second, whole), <, 1e-9);
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    TEST_COMPARE(norm(minus(found.pairs[i].slip, expected.pairs[i].slip)), <, 1e-10);
    TEST_ASSERT(found.pairs[i].state.status == expected.pairs[i].state.status);
  }
  Path again(with(back, {"Load Steps/Times={1, 2}"}));
  TEST_THROW(again.solve(folder + "/checkpoint.h5"), InputError);
}

// A lid dragged over a plane: more than a fifth of its pairs begin to slide in one step, until steps are short.
TEUCHOS_UNIT_TEST(LoadSteps, AStepInWhichManyPairsChangeIsHalved) {
  const std::vector<std::string> drawn =
      with(frictional, {"Load Steps/Times={1, 2}", "Load Steps/Factors/press=min(t, 1)", "Load Steps/Factors/push=max(0, t - 1)",
                        "Boundary Conditions/side/Expression=0*x"});
  const auto stepsOf = [&](const std::vector<std::string>& settings) {
    const std::string folder = "load_steps_halved_" + std::to_string(blocks::world()->getSize());
    Path path(settings);
    path.simulation.writeInto(folder);
    path.solve();
    return path.simulation.report();
  };
  const RunResult halved = stepsOf(drawn), whole = stepsOf(with(drawn, {"Load Steps/Largest Change=1"}));
  TEST_ASSERT(halved.code == ExitCode::Done && whole.code == ExitCode::Done);
  if (blocks::world()->getRank() != 0) return;
  TEST_ASSERT(whole.summary.find("\"count\": 2") != std::string::npos);
  TEST_ASSERT(halved.summary.find("\"count\": 2") == std::string::npos);
  TEST_ASSERT(halved.summary.find("\"work\"") != std::string::npos);
}

// The end of slip at a load reversal needs no shorter steps; its beginning, and changes between open and closed, do.
TEUCHOS_UNIT_TEST(LoadSteps, OnlyTheEndOfSlipNeedsNoShorterSteps) {
  const PairStatus all[] = {PairStatus::Open, PairStatus::Slip, PairStatus::Stick};
  std::vector<PairResult> before, now;
  for (const PairStatus from : all)
    for (const PairStatus to : all) {
      PairResult& pair = before.emplace_back();
      pair.node = GlobalId(before.size());
      pair.state = from;
      now.push_back(pair);
      now.back().state = to;
    }
  TEST_EQUALITY(changedPairs(before, now), 6);
  TEST_EQUALITY(changedWithin(before, now), 5);
  TEST_EQUALITY(changedWithin(before, before), 0);
  // Pairs of bodies that move far are in another order in each step, and some are new.
  std::rotate(now.begin(), now.begin() + 4, now.end());
  now.emplace_back().node = 100;
  TEST_EQUALITY(changedPairs(before, now), 6);
  TEST_EQUALITY(changedWithin(before, now), 5);
}

}  // namespace
}  // namespace suture
