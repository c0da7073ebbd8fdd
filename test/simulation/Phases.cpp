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

/// A block on another one, pressed and pushed to and fro with friction; a third block aside, which touches nothing, and a fourth one on it.
const char* const fourBlocks = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="aside"><Parameter name="X" type="Array(double)" value="{5, 6}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{2, 2}"/></ParameterList>
    <ParameterList name="upper"><Parameter name="X" type="Array(double)" value="{0, 2}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{12, 6}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="X" type="Array(double)" value="{-0.5, 2.5}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
      <Parameter name="Cells" type="Array(int)" value="{15, 5}"/></ParameterList>
    <ParameterList name="weight"><Parameter name="X" type="Array(double)" value="{5, 6}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{3, 2}"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Bodies">
    <ParameterList name="upper"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="aside"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Material" type="string" value="steel"/></ParameterList>
    <ParameterList name="weight"><Parameter name="Material" type="string" value="steel"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="steel"><Parameter name="Young Modulus" type="double" value="1e6"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="ground"><Parameter name="Group" type="Array(string)" value="{lower_bottom, aside_bottom}"/>
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
  return sceneOf(parseScene(fourBlocks, "four blocks", sceneSchema(), settings));
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

TEUCHOS_UNIT_TEST(Phases, ListWhatExistsWhen) {
  const Phases phases(sceneOfBlocks({"Load Steps/Removed/weight=2", "Load Steps/Placed/aside=1", "Load Steps/Removed/aside=3"}));
  TEST_EQUALITY(phases.count(), 4);
  TEST_EQUALITY(phases.end(0), 1.0);
  TEST_EQUALITY(phases.end(3), 4.0);
  TEST_ASSERT(phases.absent(0) == std::set<std::string>{"aside"});
  TEST_ASSERT(phases.absent(1).empty());
  TEST_ASSERT(phases.absent(3) == (std::set<std::string>{"aside", "weight"}));
  TEST_EQUALITY(phases.changes(2), "'weight' removed");
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
