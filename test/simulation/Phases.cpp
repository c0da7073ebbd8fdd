// Bodies removed and placed between load steps: histories of the other bodies are kept, and what was carried is released.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/MeshPart.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Phases.hpp>
#include <suture/simulation/Simulation.hpp>

#include <Teuchos_Comm.hpp>

namespace suture {
namespace {

/// A block on another one, pressed and pushed to and fro with friction; a third block aside, which touches nothing, and a fourth one on it;
/// a fifth one far away.
const char* const blocksWithFriction = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="aside"><Parameter name="X" type="Array(double)" value="{5, 6}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{2, 2}"/></ParameterList>
    <ParameterList name="upper"><Parameter name="X" type="Array(double)" value="{0, 2}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{12, 6}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="X" type="Array(double)" value="{-0.5, 2.5}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{15, 5}"/></ParameterList>
    <ParameterList name="weight"><Parameter name="X" type="Array(double)" value="{5, 6}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{3, 2}"/></ParameterList>
    <ParameterList name="far"><Parameter name="X" type="Array(double)" value="{8, 9}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{2, 2}"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Bodies">
    <ParameterList name="far"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="upper"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="aside"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="weight"><Parameter name="Material" type="string" value="steel"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="steel"><Parameter name="Young Modulus" type="double" value="1e6"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="ground"><Parameter name="Group" type="Array(string)" value="{lower_bottom, aside_bottom, far_bottom}"/>
      <Parameter name="Type" type="string" value="Displacement"/><Parameter name="Value" type="Array(double)" value="{0, 0}"/></ParameterList>
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Components" type="string" value="y"/><Parameter name="Expression y" type="string" value="-0.02 + 0.005*x"/></ParameterList>
    <ParameterList name="push"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Components" type="string" value="x"/><Parameter name="Value" type="Array(double)" value="{0.01}"/></ParameterList>
    <ParameterList name="load"><Parameter name="Group" type="string" value="weight_top"/><Parameter name="Type" type="string" value="Pressure"/>
      <Parameter name="Value" type="Array(double)" value="{1000}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Contact">
    <ParameterList name="joint">
      <Parameter name="Side A" type="string" value="upper_bottom"/><Parameter name="Side B" type="string" value="lower_top"/>
      <Parameter name="Law" type="string" value="Coulomb"/><ParameterList name="Coulomb"><Parameter name="Coefficient" type="string" value="0.3"/></ParameterList>
    </ParameterList>
    <ParameterList name="glue">
      <Parameter name="Side A" type="string" value="weight_bottom"/><Parameter name="Side B" type="string" value="aside_top"/>
      <Parameter name="Law" type="string" value="Tied"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Load Steps"><Parameter name="Times" type="Array(double)" value="{1, 2, 3, 4}"/>
    <ParameterList name="Factors"><Parameter name="push" type="string" value="{1, -1, 1, 0}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Outer Solver"><Parameter name="Tolerance" type="double" value="1e-11"/></ParameterList>
  <ParameterList name="Partition"><ParameterList name="METIS"><Parameter name="Subdomains" type="int" value="6"/></ParameterList></ParameterList>
</ParameterList>)xml";

Scene sceneOfBlocks(const std::vector<std::string>& settings) {
  return sceneOf(parseScene(blocksWithFriction, "blocks", sceneSchema(), settings));
}

Solution solvedPath(const CommPtr& comm, const std::vector<std::string>& settings) {
  const SolvedScene scene = solve(prepare(check(cut(read(RunContext(comm), sceneOfBlocks(settings))))));
  return scene.solution();
}

std::vector<PairResult> pairsOfContact(const Solution& solution, int line) {
  std::vector<PairResult> all;
  for (const PairResult& pair : solution.pairs)
    if (pair.line == line) all.push_back(pair);
  return all;
}

TEUCHOS_UNIT_TEST(Phases, KeepHistoriesOfBodiesThatTakeNoPart) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  const Solution alone = solvedPath(comm, {}), phased = solvedPath(comm, {"Load Steps/Removed/weight=2", "Load Steps/Removed/aside=3"});
  TEST_ASSERT(alone.isValid() && phased.isValid());
  const std::vector<PairResult> before = pairsOfContact(alone, 0), after = pairsOfContact(phased, 0);
  TEST_EQUALITY(before.size(), after.size());
  double force = 0.0, slip = 0.0;
  for (const PairResult& pair : before) force = std::max(force, norm(pair.onB())), slip = std::max(slip, norm(pair.slip));
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    TEST_ASSERT(before[i].state.status == after[i].state.status);
    TEST_COMPARE(norm(minus(before[i].onB(), after[i].onB())), <, 1e-7 * force);
    TEST_COMPARE(norm(minus(before[i].slip, after[i].slip)), <, 1e-7 * slip);
    TEST_COMPARE(std::abs(before[i].dissipated - after[i].dissipated), <, 1e-7 * force * slip);
    TEST_ASSERT(before[i].dissipated > 0.0 || !before[i].past.slipped);
  }
}

TEUCHOS_UNIT_TEST(Phases, PlaceABodyWithoutStressOnADeformedOne) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  // 'aside' is compressed by its own load before 'weight' is glued to it; then nothing changes.
  const Solution solution = solvedPath(
      comm, {"Load Steps/Placed/weight=2", "Boundary Conditions/load/Group=aside_right", "Load Steps/Factors/push={1, 1, 1, 1}"});
  TEST_ASSERT(solution.isValid());
  double force = 0.0;
  for (const PairResult& pair : pairsOfContact(solution, 1)) force = std::max(force, norm(pair.onB()));
  TEST_COMPARE(force, <, 1e-6 * 1000.0);
}

TEUCHOS_UNIT_TEST(Phases, KeepTheFitOfAPlacedBodyInLaterPhases) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  for (const char* law : {"Tied", "Frictionless"}) {
    const Solution solution = solvedPath(
        comm, {"Load Steps/Placed/weight=1", "Boundary Conditions/load/Group=aside_right", "Load Steps/Removed/upper=2",
               "Load Steps/Removed/lower=3", "Boundary Conditions/ground/Group={lower_bottom, aside_bottom, far_bottom, weight_top}",
               std::string("Contact/glue/Law=") + law});
    TEST_ASSERT(solution.isValid());
    double force = 0.0, gap = 0.0;
    for (const PairResult& pair : pairsOfContact(solution, 0)) force = std::max(force, norm(pair.onB())), gap = std::max(gap, pair.gap);
    TEST_COMPARE(force, <, 1e-6 * 1000.0);
    TEST_COMPARE(gap, <, 1e-9);
  }
}

/// A run on a path with phases that may be cut off at a time, as by a failure, and may continue from a checkpoint.
struct PhasedRun {
  PhasedRun(const std::vector<std::string>& settings, const std::string& push)
      : simulation(Teuchos::DefaultComm<int>::getComm(), sceneOfBlocks(with(settings, push))) {}
  static std::vector<std::string> with(std::vector<std::string> settings, const std::string& push) {
    settings.push_back("Load Steps/Factors/push=" + push);
    for (const char* one : {"Load Steps/Times={1, 2, 2.5, 3, 4}", "Load Steps/Halvings=0", "Output/Fields=false"}) settings.push_back(one);
    return settings;
  }
  Simulation simulation;
};

// Cut off at the end of a phase and within one: the rest is that of an uninterrupted run. Forces of 'weight' are released until the end, or
// 'weight' is placed, while 'far' goes.
TEUCHOS_UNIT_TEST(Phases, GoOnFromACheckpoint) {
  const std::string ranks = std::to_string(Teuchos::DefaultComm<int>::getComm()->getSize());
  const std::string gone = "Load Steps/Removed/far=2", glued = "Boundary Conditions/load/Group=aside_right";
  const std::vector<std::vector<std::string>> scenes{{gone, "Load Steps/Removed/weight=1", "Load Steps/Release/weight={0.2, 0.5, 0.7, 1}"},
                                                     {gone, glued, "Load Steps/Placed/weight=1"}};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    PhasedRun whole(scenes[i], "sin(1.7*t)");
    const Solution& expected = whole.simulation.solve();
    TEST_ASSERT(whole.simulation.ending() == ExitCode::Done);
    double force = 0.0, slip = 0.0;
    for (const PairResult& pair : expected.pairs) force = std::max(force, norm(pair.onB())), slip = std::max(slip, norm(pair.slip));
    for (const std::string cut : {"2", "2.5"}) {
      const std::string folder = "phases_" + std::to_string(i) + "_" + cut + "_" + ranks;
      PhasedRun first(scenes[i], "sin(1.7*t) + 0*sqrt(" + cut + " - t)"), rest(scenes[i], "sin(1.7*t)");
      first.simulation.writeInto(folder);
      TEST_THROW(first.simulation.solve(), InputError);
      const Solution& found = rest.simulation.solve(folder + "/checkpoint.h5");
      TEST_ASSERT(rest.simulation.ending() == ExitCode::Done);
      TEST_COMPARE(std::abs(found.energy - expected.energy), <, 1e-9 * std::abs(expected.energy));
      TEST_EQUALITY(found.pairs.size(), expected.pairs.size());
      for (std::size_t p = 0; p < std::min(found.pairs.size(), expected.pairs.size()); ++p) {
        const PairResult &a = found.pairs[p], &b = expected.pairs[p];
        TEST_ASSERT(a.state.status == b.state.status);
        TEST_COMPARE(norm(minus(a.onB(), b.onB())), <, 1e-9 * force);
        TEST_COMPARE(norm(minus(a.slip, b.slip)), <, 1e-9 * slip);
        TEST_COMPARE(std::abs(a.dissipated - b.dissipated), <, 1e-9 * force * slip);
      }
    }
  }
}

TEUCHOS_UNIT_TEST(Phases, RefuseCheckpointsAfterOtherChanges) {
  const std::string ranks = std::to_string(Teuchos::DefaultComm<int>::getComm()->getSize());
  const std::string gone = "Load Steps/Removed/far=2", weight = "Load Steps/Removed/weight=1", cut = "sin(t) + 0*sqrt(2.5 - t)";
  const std::vector<std::string> scene{gone, weight};
  const auto checkpointOf = [&](const std::vector<std::string>& settings, const std::string& name) {
    PhasedRun run(settings, cut);
    run.simulation.writeInto(name + "_" + ranks);
    TEST_THROW(run.simulation.solve(), InputError);
    return name + "_" + ranks + "/checkpoint.h5";
  };
  const std::string phased = checkpointOf(scene, "phases_own"), plain = checkpointOf({}, "phases_none");
  const auto refusal = [&](const std::vector<std::string>& settings, const std::string& checkpoint) -> std::string {
    try {
      PhasedRun(settings, "sin(t)").simulation.solve(checkpoint);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto contains = [&](const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; };
  TEST_EQUALITY(refusal(scene, phased), "");
  TEST_EQUALITY(refusal({gone, weight, "Load Steps/Removed/aside=3"}, phased), "");  // another future
  TEST_ASSERT(contains(refusal({gone, "Load Steps/Removed/weight=2"}, phased),
                       "after other changes: t = 1: 'weight' removed; t = 2: 'far' removed; expected, as in this scene: t = 2: 'far' "
                       "removed, 'weight' removed"));
  TEST_ASSERT(
      contains(refusal({gone, weight, "Load Steps/Release/weight={0.4, 1}"}, phased), "forces released to 40, 100 % at t = 2, 2.5"));
  TEST_ASSERT(contains(refusal(scene, plain), "after other changes: no change; expected"));
  TEST_ASSERT(contains(refusal({}, phased), "another mesh"));
  TEST_ASSERT(contains(refusal({gone, weight, "Output/Displacements Since=1"}, phased), "has no displacements of that time"));
}

TEUCHOS_UNIT_TEST(Release, IsLinearBetweenTheEndsOfSteps) {
  const Release release(1.0, {2.0, 4.0}, {0.4, 1.0});
  TEST_EQUALITY(release.remaining(0.5), 1.0);
  TEST_EQUALITY(release.remaining(1.0), 1.0);
  TEST_FLOATING_EQUALITY(release.remaining(1.5), 0.8, 1e-15);
  TEST_FLOATING_EQUALITY(release.remaining(2.0), 0.6, 1e-15);
  TEST_FLOATING_EQUALITY(release.remaining(3.0), 0.3, 1e-15);
  TEST_EQUALITY(release.remaining(4.0), 0.0);
  TEST_EQUALITY(release.remaining(5.0), 0.0);
}

TEUCHOS_UNIT_TEST(Phases, ListWhatExistsWhen) {
  const Phases phases(sceneOfBlocks({"Load Steps/Removed/weight=2", "Load Steps/Placed/aside=1", "Load Steps/Removed/aside=3"}));
  TEST_EQUALITY(phases.count(), 4);
  TEST_EQUALITY(phases.end(0), 1.0);
  TEST_EQUALITY(phases.end(3), 4.0);
  TEST_ASSERT(phases.absent(0) == std::set<std::string>{"aside"});
  TEST_ASSERT(phases.absent(1).empty());
  TEST_ASSERT(phases.absent(3) == (std::set<std::string>{"aside", "weight"}));
  TEST_EQUALITY(phases.changes(2), "'weight' removed");
  TEST_EQUALITY(phases.phaseAt(1.0), 0);
  TEST_EQUALITY(phases.phaseAt(1.5), 1);
  TEST_EQUALITY(phases.phaseAt(4.0), 3);
  TEST_EQUALITY(phases.changesBefore(1.0), Phases::kNoChange);
  TEST_EQUALITY(phases.changesBefore(3.0), "t = 1: 'aside' placed; t = 2: 'weight' removed");
  TEST_ASSERT(Phases(sceneOfBlocks({})).empty());
}

TEUCHOS_UNIT_TEST(MeshPart, KeepsNodesElementsAndGroupsInTheirOrder) {
  Box box;
  box.name = "b", box.nx = 3, box.ny = 2;
  const Mesh whole = boxes({box});
  std::vector<char> keeps(static_cast<std::size_t>(whole.elements()), 1);
  const int gone = whole.sideGroups.at("b_left").front().element;
  keeps[static_cast<std::size_t>(gone)] = 0;
  const MeshPart part = partOf(whole, keeps);
  TEST_EQUALITY(part.mesh.elements(), whole.elements() - 1);
  TEST_EQUALITY(part.mesh.sideGroups.at("b_left").size(), whole.sideGroups.at("b_left").size() - 1);
  TEST_EQUALITY(part.mesh.elementGroups.at("b").size(), whole.elementGroups.at("b").size() - 1);
  for (int node = 0; node < part.mesh.nodes(); ++node)
    TEST_ASSERT(part.mesh.point(node) == whole.point(part.nodeOfWhole[static_cast<std::size_t>(node)]));
  for (int e = 0; e < part.mesh.elements(); ++e)
    for (std::size_t k = 0; k < part.mesh.nodesOf(e).size(); ++k)
      TEST_EQUALITY(part.nodeOfWhole[static_cast<std::size_t>(part.mesh.nodesOf(e)[k])], whole.nodesOf(e < gone ? e : e + 1)[k]);
}

}  // namespace
}  // namespace suture
