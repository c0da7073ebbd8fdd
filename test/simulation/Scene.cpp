// Scenes made in C++ against the same scenes in XML, and their errors.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Simulation.hpp>

#include <filesystem>

namespace suture {
namespace {

std::shared_ptr<const MaterialLaw> isotropic(double young, double poisson) {
  return std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson});
}

Mesh mesh() { return boxes({{"upper", 0, 2, 0, 1, 12, 6}, {"lower", 0, 3, -1, 0, 15, 5}}); }

ElasticModel model() {
  ElasticModel all;
  all.addBody("upper", isotropic(2e6, 0.3));
  all.addBody("lower", isotropic(1e7, 0.2));
  all.loads = {Load::pressure("upper_top", 1e4), Load::bodyForce({0, -2e3, 0}, "upper")};
  return all;
}

std::vector<Condition> held() { return {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_left", {0}, {0})}; }

const char* const inXml = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="upper"><Parameter name="X" type="Array(double)" value="{0, 2}"/><Parameter name="Y" type="Array(double)" value="{0, 1}"/>
      <Parameter name="Cells" type="Array(int)" value="{12, 6}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="X" type="Array(double)" value="{0, 3}"/><Parameter name="Y" type="Array(double)" value="{-1, 0}"/>
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
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Pressure"/>
      <Parameter name="Value" type="Array(double)" value="{1e4}"/></ParameterList>
    <ParameterList name="weight"><Parameter name="Body" type="string" value="upper"/><Parameter name="Type" type="string" value="Body Force"/>
      <Parameter name="Value" type="Array(double)" value="{0, -2e3}"/></ParameterList>
    <ParameterList name="ground"><Parameter name="Group" type="string" value="lower_bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0, 0}"/></ParameterList>
    <ParameterList name="guide"><Parameter name="Group" type="string" value="upper_left"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Components" type="string" value="x"/><Parameter name="Value" type="Array(double)" value="{0}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Contact"><ParameterList name="joint">
    <Parameter name="Side A" type="string" value="upper_bottom"/><Parameter name="Side B" type="string" value="lower_top"/>
  </ParameterList></ParameterList>
</ParameterList>)xml";

Scene inCpp(const std::vector<std::string>& settings = {}) {
  return makeScene(model(), mesh, held(), {Contact::between("upper_bottom", "lower_top")}, settings);
}

Scene fromXml(const std::vector<std::string>& settings) { return sceneOf(parseScene(inXml, "two blocks", sceneSchema(), settings)); }

/// Largest difference of pressures over the largest pressure. On rank 0.
double difference(const Solution& a, const Solution& b) {
  double size = 0.0, far = a.pairs.size() == b.pairs.size() ? 0.0 : 1.0;
  for (std::size_t i = 0; i < std::min(a.pairs.size(), b.pairs.size()); ++i) {
    size = std::max(size, std::abs(b.pairs[i].pressure));
    far = std::max(far, std::abs(a.pairs[i].pressure - b.pairs[i].pressure));
  }
  return size > 0.0 ? far / size : 0.0;
}

TEUCHOS_UNIT_TEST(Scene, IsTheSameInCppAndInXml) {
  for (const std::string method : {"Active Set", "Monolithic"}) {
    const std::vector<std::string> settings{"Outer Solver/Type=" + method, "Outer Solver/Tolerance=1e-12", "Partition/METIS/Subdomains=5"};
    Simulation one(blocks::world(), inCpp(settings)), other(blocks::world(), fromXml(settings));
    const Solution &a = one.solve(), &b = other.solve();
    TEST_ASSERT(one.ending() == ExitCode::Done && other.ending() == ExitCode::Done);
    TEST_EQUALITY(a.iterations, b.iterations);
    TEST_COMPARE(difference(a, b), <, 1e-13);
    if (blocks::world()->getRank() != 0) continue;
    double force = 0.0;  // the weight and the load: 2 m x (1e4 + 2e3) N/m
    for (const PairResult& pair : a.pairs) force += pair.force;
    TEST_FLOATING_EQUALITY(force, 2.4e4, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(Scene, WritesTheFilesOfARun) {
  const std::string folder = "scene_" + std::to_string(blocks::world()->getSize()) + "_out";
  ElasticModel sheet = model();
  sheet.plane = PlaneModel::Stress;
  Simulation simulation(blocks::world(), makeScene(sheet, mesh, held(), {Contact::between("upper_bottom", "lower_top")}, {"Title=mine"}));
  simulation.writeInto(folder);
  simulation.solve();
  const RunResult result = simulation.report();
  TEST_ASSERT(result.code == ExitCode::Done);
  if (blocks::world()->getRank() != 0) return;
  for (const char* file : {"summary.json", "fields_0000.vtkhdf", "contact_0000.vtkhdf", "history.csv"})
    TEST_ASSERT(std::filesystem::exists(folder + "/" + file));
  for (const char* text : {"mine", "Plane Stress", "upper_bottom on lower_top"})
    TEST_ASSERT(result.summary.find(text) != std::string::npos);
}

TEUCHOS_UNIT_TEST(Scene, MayHaveARigidObstacleAndNoOtherBody) {
  ElasticModel one;
  one.addBody("body", isotropic(2e6, 0.0));
  const auto box = [] { return boxes({{"body", 0, 1, 0, 1, 4, 4}}); };
  const std::vector<Condition> push{Condition::displacement("body_top", {0, -0.1})};
  for (const Obstacle& obstacle : {Obstacle::line({0, 0, 0}, {0, 3, 0}), Obstacle::circle({0.5, -1e6, 0}, 1e6)}) {
    Simulation simulation(blocks::world(), makeScene(one, box, push, {Contact::with(obstacle, "body_bottom")}));
    const Solution& solution = simulation.solve();
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    for (const PairResult& pair : solution.pairs) TEST_FLOATING_EQUALITY(pair.pressure, 2e5, 1e-5);
  }
}

/// All errors of a scene, from its construction to its first stages.
std::string complaint(const std::function<Scene()>& make) {
  try {
    read(RunContext(blocks::world()), make());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(Scene, IsRefusedWithAllThatIsWrong) {
  const auto says = [&](const std::string& text, const std::vector<std::string>& wanted) {
    for (const std::string& one : wanted) {
      if (text.find(one) == std::string::npos) out << "'" << one << "' is not in:\n" << text << "\n";
      TEST_ASSERT(text.find(one) != std::string::npos);
    }
  };
  const Contact joint = Contact::between("upper_bottom", "lower_top");
  says(complaint([&] {
         return makeScene(model(), mesh, held(), {joint, joint}, {"Outer Solver/Tolerence=1"});
       }),
       {"Tolerence", "Tolerance"});
  says(complaint([&] {
         return makeScene(model(), mesh, held(), {joint}, {"Model=Plane Stress", "Mesh/Generator=Boxes"});
       }),
       {"Model: a scene made in C++ defines it", "Mesh/Generator: a scene made in C++ defines it"});
  says(complaint([&] {
         ElasticModel wrong;
         wrong.loads = {Load::pressure("upper_top", 1.0)};
         wrong.loads[0].expressions.resize(2, Expression([](const Point&) { return 1.0; }));
         return makeScene(wrong, mesh, held(), {joint, joint});
       }),
       {"ElasticModel::bodies", "ElasticModel::loads/1: 2 expressions; expected 1", "Contact/upper_bottom on lower_top: two contacts"});
  says(complaint([&] {
         ElasticModel wrong = model();
         wrong.loads = {Load::pressure("uper_top", 1.0), Load::bodyForce({0, 1, 0}, "uper")};
         std::vector<Condition> conditions = held();
         conditions.push_back(Condition::displacement("upper_right", {0, 0}, {0}));
         conditions.push_back(Condition::displacement("upper_right", {0}, {2}));
         conditions.push_back(Condition::bilateral("lower_lefd"));
         return makeScene(wrong, mesh, conditions, {Contact::between("upper_bottom", "lower_tob")});
       }),
       {"upper_top", "ElasticModel::loads/2/Body", "Boundary Conditions/upper_right/Value: 2 values for 1 components",
        "Boundary Conditions/upper_right/Components: expected components between 0 and 1", "Boundary Conditions/lower_lefd/Group",
        "Contact/upper_bottom on lower_tob/Side B"});
  says(complaint([&] {
         ElasticModel wrong;
         wrong.addBody("upper", isotropic(2e6, 0.5));
         return makeScene(wrong, mesh, held(), {});
       }),
       {"the stiffness of the material is not finite"});
}

TEUCHOS_UNIT_TEST(Scene, BeginsWithTheLevelsItIsGiven) {
  const std::vector<std::string> settings{"Outer Solver/Start=Nested", "Outer Solver/Nested/Levels={coarse}"};
  Simulation lacks(blocks::world(), inCpp(settings));
  TEST_THROW(lacks.solve(), InputError);
  Scene scene = inCpp(settings);
  const auto coarse = [] { return boxes({{"upper", 0, 2, 0, 1, 6, 3}, {"lower", 0, 3, -1, 0, 8, 3}}); };
  scene.levels = {makeScene(model(), coarse, held(), {Contact::between("upper_bottom", "lower_top")})};
  Simulation nested(blocks::world(), scene), plain(blocks::world(), inCpp());
  const Solution &a = nested.solve(), &b = plain.solve();
  TEST_ASSERT(nested.ending() == ExitCode::Done);
  TEST_COMPARE(difference(a, b), <, 1e-6);
}

TEUCHOS_UNIT_TEST(Scene, ChoosesElementsThatDoNotLock) {
  ElasticModel all;
  all.addBody("soft", isotropic(2e6, 0.4999));
  all.addBody("stiff", isotropic(2e6, 0.3));
  TEST_ASSERT(all.materialOfBody[0].element == ElementForm::Mixed);
  TEST_ASSERT(all.materialOfBody[1].element == ElementForm::Displacement);
  ElasticModel sheet;
  sheet.plane = PlaneModel::Stress;
  sheet.addBody("soft", isotropic(2e6, 0.4999));
  TEST_ASSERT(sheet.materialOfBody[0].element == ElementForm::Displacement);
}

}  // namespace
}  // namespace suture
