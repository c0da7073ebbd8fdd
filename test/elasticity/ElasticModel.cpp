#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/LockingNotes.hpp>

using namespace suture;

namespace {

Schema sceneSchema() {
  Schema scene;
  addModelParameters(scene);
  return scene.list("Bodies", Schema().each("body", bodySchema()))
      .list("Materials", Schema().each("material", materialSchema()))
      .list("Boundary Conditions", Schema().each("condition", boundaryConditionSchema()));
}

const std::string scene = R"xml(<ParameterList name="Suture">
  <Parameter name="Model" type="string" value="Plane Stress"/>
  <ParameterList name="Bodies">
    <ParameterList name="lower"><Parameter name="Material" type="string" value="rock"/></ParameterList>
    <ParameterList name="upper"><Parameter name="Material" type="string" value="steel"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="steel"><Parameter name="Young Modulus" type="double" value="210e9"/>
      <Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList>
    <ParameterList name="rock"><Parameter name="Young Modulus" type="double" value="0.52e10"/>
      <Parameter name="Poisson Ratio" type="double" value="0.18"/></ParameterList>
  </ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="overburden"><Parameter name="Group" type="string" value="top"/>
      <Parameter name="Type" type="string" value="Pressure"/><Parameter name="Value" type="double" value="0.5e7"/></ParameterList>
    <ParameterList name="rollers"><Parameter name="Group" type="string" value="bottom"/>
      <Parameter name="Type" type="string" value="Bilateral"/></ParameterList>
    <ParameterList name="wind"><Parameter name="Group" type="string" value="left"/>
      <Parameter name="Type" type="string" value="Traction"/><Parameter name="Value" type="Array(double)" value="{3.0, -4.0}"/></ParameterList>
    <ParameterList name="weight"><Parameter name="Type" type="string" value="Body Force"/>
      <Parameter name="Value" type="Array(double)" value="{0.0, -2.6e4}"/></ParameterList>
    <ParameterList name="magnet"><Parameter name="Type" type="string" value="Body Force"/><Parameter name="Body" type="string" value="upper"/>
      <Parameter name="Value" type="Array(double)" value="{1.0, 0.0}"/></ParameterList>
  </ParameterList>
</ParameterList>)xml";

ElasticModel modelOf(const std::vector<std::string>& overrides = {}) {
  return makeElasticModel(*parseScene(scene, "scene.xml", sceneSchema(), overrides).parameters);
}

std::vector<Problem> problemsOf(const std::vector<std::string>& overrides) {
  try {
    modelOf(overrides);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

bool says(const Problem& problem, const std::string& path, const std::string& words) {
  return problem.path == path && problem.message.find(words) != std::string::npos;
}

}  // namespace

TEUCHOS_UNIT_TEST(ElasticModel, HoldsTheValuesOfTheScene) {
  const ElasticModel model = modelOf();
  TEST_ASSERT(model.plane == PlaneModel::Stress);
  TEST_EQUALITY(model.bodies.size(), 2u);
  TEST_EQUALITY(model.bodies[1], "upper");
  TEST_EQUALITY(model.materialOfBody[0].name, "rock");
  TEST_EQUALITY(model.materialOfBody[0].poisson, 0.18);
  TEST_EQUALITY(model.materialOfBody[1].young, 210e9);
  TEST_EQUALITY(model.loads.size(), 4u);
  TEST_ASSERT(model.loads[0].kind == Load::Kind::Pressure);
  TEST_ASSERT(model.loads[0].groups == std::vector<std::string>{"top"});
  TEST_EQUALITY(model.loads[0].value[0], 0.5e7);
  TEST_ASSERT(model.loads[1].kind == Load::Kind::Traction);
  TEST_EQUALITY(model.loads[1].value[1], -4.0);
  TEST_ASSERT(model.loads[2].kind == Load::Kind::BodyForce);
  TEST_EQUALITY(model.loads[2].body, "");
  TEST_EQUALITY(model.loads[3].body, "upper");
}

TEUCHOS_UNIT_TEST(ElasticModel, NamesAllProblemsAtOnce) {
  const std::vector<Problem> problems =
      problemsOf({"Bodies/upper/Material=stel", "Boundary Conditions/magnet/Body=uper", "Boundary Conditions/wind/Value={1.0}",
                  "Boundary Conditions/overburden/Value={1.0, 2.0}"});
  TEST_EQUALITY(problems.size(), 4u);
  if (problems.size() != 4u) return;
  TEST_ASSERT(says(problems[0], "Bodies/upper/Material", "Did you mean 'steel'"));
  TEST_ASSERT(says(problems[1], "Boundary Conditions/overburden/Value", "2 values; this Pressure needs 1 value, or Expression"));
  TEST_ASSERT(says(problems[2], "Boundary Conditions/wind/Value",
                   "1 values; this Traction needs 2 values, as in {0.0, 0.0}, or Expression x and Expression y"));
  TEST_ASSERT(says(problems[3], "Boundary Conditions/magnet/Body", "Did you mean 'upper'"));
}

TEUCHOS_UNIT_TEST(ElasticModel, KnowsTheMaterialOfEveryRegion) {
  const ElasticModel model = modelOf({"Bodies/upper/Regions/seam/Group=seam", "Bodies/upper/Regions/seam/Material=rock",
                                      "Bodies/lower/Regions/anchor/Group=anchor", "Bodies/lower/Regions/anchor/Material=steel"});
  TEST_EQUALITY(model.materialOfRegion.size(), 2u);
  if (model.materialOfRegion.size() != 2u) return;
  CellBlock block;
  block.regions = {1, -1, 0};  // body by body: the anchor of `lower`, the seam of `upper`
  TEST_EQUALITY(model.materialOf(block, 0, 1).young, 0.52e10);
  TEST_EQUALITY(model.materialOf(block, 1, 1).young, 210e9);
  TEST_EQUALITY(model.materialOf(block, 1, 0).young, 0.52e10);
  TEST_EQUALITY(model.materialOf(block, 2, 0).young, 210e9);
  TEST_THROW(model.materialOf(CellBlock(), 0, 0), InternalError);  // mesh without regions
  TEST_EQUALITY(modelOf().materialOf(CellBlock(), 0, 1).young, 210e9);
  const std::vector<Problem> problems = problemsOf({"Bodies/upper/Regions/seam/Group=seam", "Bodies/upper/Regions/seam/Material=rok"});
  TEST_ASSERT(problems.size() == 1 && says(problems[0], "Bodies/upper/Regions/seam/Material", "Did you mean 'rock'"));
}

TEUCHOS_UNIT_TEST(ElasticModel, TakesRandomLoads) {
  const std::string name = "Boundary Conditions/noise/";
  const ElasticModel model = modelOf({name + "Type=Random Load", name + "Amplitude=2.5", name + "Seed=-4", name + "Body=lower"});
  TEST_EQUALITY(model.loads.size(), 5u);
  const Load& load = model.loads.back();
  TEST_ASSERT(load.kind == Load::Kind::Random && load.onBody());
  TEST_EQUALITY(load.value[0], 2.5);
  TEST_EQUALITY(load.seed, -4);
  TEST_ASSERT(load.actsOn("lower") && !load.actsOn("upper"));
  TEST_EQUALITY(modelOf({name + "Type=Random Load", name + "Amplitude=2.5"}).loads.back().seed, 0);
  TEST_ASSERT(problemsOf({name + "Type=Random Load", name + "Amplitude=0.0"})[0].path == "Boundary Conditions/noise/Amplitude");
  TEST_ASSERT(says(problemsOf({name + "Type=Random Load"})[0], "Boundary Conditions/noise/Amplitude", "is missing"));
}

TEUCHOS_UNIT_TEST(ElasticModel, RefusesMaterialsThatDoNotExistInNature) {
  for (const std::string poisson : {"0.5", "-1.0", "0.7"}) {
    const std::vector<Problem> problems = problemsOf({"Materials/rock/Poisson Ratio=" + poisson});
    TEST_EQUALITY(problems.size(), 1u);
    TEST_ASSERT(problems.size() == 1 && problems[0].path == "Materials/rock/Poisson Ratio");
  }
  TEST_ASSERT(says(problemsOf({"Materials/rock/Poisson Ratio=0.5"})[0], "Materials/rock/Poisson Ratio", "Materials/<name>/Element"));
  for (const std::string young : {"0.0", "-1e9"}) TEST_EQUALITY(problemsOf({"Materials/rock/Young Modulus=" + young}).size(), 1u);
  TEST_EQUALITY(problemsOf({"Materials/rock/Poisson Ratio=0.4999"}).size(), 0u);
}

TEUCHOS_UNIT_TEST(ElasticModel, ReadsElementsAndTheAxisymmetricModel) {
  const ElasticModel model = modelOf({"Model=Axisymmetric", "Materials/rock/Element=Mixed", "Materials/steel/Allow Locking=true"});
  TEST_ASSERT(model.axisymmetric && model.plane == PlaneModel::Strain);
  TEST_ASSERT(model.materialOfBody[0].element == ElementForm::Mixed && !model.materialOfBody[0].allowLocking);
  TEST_ASSERT(model.materialOfBody[1].element == ElementForm::Displacement && model.materialOfBody[1].allowLocking);
  TEST_ASSERT(!modelOf().axisymmetric);
  CellBlock plane;
  TEST_THROW(requireGeometry(plane, model), InternalError);
  plane.axisymmetric = true;
  requireGeometry(plane, model);
  TEST_THROW(requireGeometry(plane, modelOf()), InternalError);
  // The scene of this test is of plane stress.
  TEST_ASSERT(
      says(problemsOf({"Materials/rock/Element=Mixed"})[0], "Materials/rock/Element", "Mixed in plane stress, where no element locks"));
}

TEUCHOS_UNIT_TEST(ElasticModel, ReadsSolidsWithThreeComponents) {
  const std::vector<std::string> solid{"Model=Solid", "Boundary Conditions/wind/Value={3.0, -4.0, 5.0}",
                                       "Boundary Conditions/weight/Value={0.0, 0.0, -2.6e4}", "Boundary Conditions/magnet/Value={1, 2, 3}"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), solid.begin(), solid.end());
    return more;
  };
  const std::string name = "Boundary Conditions/new/";
  const ElasticModel model = modelOf(with({name + "Type=Moment", name + "Group=top", name + "Value={1.0, -2.0, 3.0}"}));
  TEST_EQUALITY(model.dimension, 3);
  TEST_EQUALITY(modelName(model), "Solid");
  TEST_ASSERT(model.plane == PlaneModel::Strain && !model.axisymmetric);
  TEST_ASSERT((model.loads[1].value == Point{3.0, -4.0, 5.0}));
  TEST_ASSERT((model.loads[2].value == Point{0.0, 0.0, -2.6e4}));
  TEST_ASSERT((model.loads.back().value == Point{1.0, -2.0, 3.0}));
  const ElasticModel turning = modelOf(with({name + "Type=Rotation", name + "Value={0.0, 2.0, 1.0}", name + "Point={1.0, 2.0, 3.0}",
                                             "Materials/rock/Density=2.0", "Materials/steel/Density=7.0"}));
  TEST_ASSERT((turning.loads.back().value == Point{0.0, 2.0, 1.0} && turning.loads.back().place == Point{1.0, 2.0, 3.0}));
  const ElasticModel strained = modelOf(with({name + "Type=Initial Strain", name + "Value={1.0, 2.0, 3.0, 4.0, 5.0, 6.0}"}));
  TEST_ASSERT((strained.loads.back().tensor == std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  const ElasticModel moved =
      modelOf(with({name + "Type=Mean Displacement", name + "Group=top", name + "Components=xz", name + "Value={0.5, 0.25}"}));
  TEST_EQUALITY(moved.loads.size(), 6u);
  TEST_ASSERT((moved.loads.back().axis == Point{0, 0, 1} && moved.loads.back().target == 0.25));
  const ElasticModel bolt = modelOf(
      with({name + "Type=Preload", name + "Body=upper", name + "Direction={0.0, 3.0, 4.0}", name + "Length=2.0", name + "Value={10.0}"}));
  Load shortened = bolt.loads.back();
  shortened.setAmount(0.5);  // -d/l n n^T with n = (0, .6, .8)
  const double expected[] = {0.0, -0.25 * 0.36, -0.25 * 0.64, 0.0, -0.25 * 2 * 0.48, 0.0};
  for (int k = 0; k < 6; ++k) TEST_COMPARE(std::abs(shortened.tensor[k] - expected[k]), <, 1e-15);

  const std::vector<Problem> two = problemsOf({"Model=Solid"});  // values of the plane
  TEST_EQUALITY(two.size(), 3u);
  TEST_ASSERT(!two.empty() && says(two[0], "Boundary Conditions/wind/Value", "this Traction needs 3 values, as in {0.0, 0.0, 0.0}"));
}

TEUCHOS_UNIT_TEST(ElasticModel, RequiresAMeshOfItsDimension) {
  CellBlock plane, space;
  space.dimension = 3;
  const auto messageOf = [](const CellBlock& mesh, const ElasticModel& model) {
    try {
      requireDimension(mesh, "x.msh", model);
    } catch (const InputError& error) {
      return error.problems().front().path + ": " + error.problems().front().message;
    }
    return std::string();
  };
  ElasticModel strain, solid;
  solid.dimension = 3;
  TEST_EQUALITY(messageOf(plane, strain) + messageOf(space, solid), "");
  TEST_EQUALITY(messageOf(space, strain), "Model: 'Plane Strain' needs a plane mesh; the mesh x.msh has volume elements: expected 'Solid'");
  TEST_EQUALITY(messageOf(plane, solid),
                "Model: 'Solid' needs volume elements; the mesh x.msh is plane: expected 'Plane Strain', 'Plane Stress' or 'Axisymmetric'");
  TEST_THROW(requireGeometry(space, strain), InternalError);
}

TEUCHOS_UNIT_TEST(ElasticModel, RefusesTetrahedraThatLock) {
  CellBlock block;
  block.dimension = 3;
  block.cells = {Cell::Hexahedron8, Cell::Tetrahedron10, Cell::Tetrahedron4};
  ElasticModel model;
  model.dimension = 3;
  model.bodies = {"seal"};
  model.materialOfBody = {{"rubber", 1.0, 0.495, ElementForm::Mixed}};
  Problems problems;
  checkElements(
      block, [](int) { return 0; }, model, problems);
  TEST_ASSERT(
      problems.list().size() == 1 &&
      says(problems.list()[0], "Materials/rubber/Poisson Ratio", "with 4-node tetrahedra in the body 'seal': above 0.49 they lock") &&
      says(problems.list()[0], "Materials/rubber/Poisson Ratio", "Mesh it with 10-node tetrahedra or hexahedra"));
}

TEUCHOS_UNIT_TEST(ElasticModel, RefusesTrianglesThatLockAndSuggestsAlternatives) {
  CellBlock block;
  block.cells = {Cell::Quadrilateral4, Cell::Triangle3, Cell::Triangle6, Cell::Triangle3};
  const auto problemsIn = [&](std::vector<std::string> overrides, int body) {
    overrides.insert(overrides.begin(), "Model=Plane Strain");
    Problems problems;
    checkElements(
        block, [&](int) { return body; }, modelOf(overrides), problems);
    return problems.list();
  };
  TEST_EQUALITY(problemsIn({"Materials/rock/Poisson Ratio=0.49"}, 0).size(), 0u);
  const std::string nearly = "Materials/rock/Poisson Ratio=0.4901";
  const std::vector<Problem> found = problemsIn({nearly}, 0);
  TEST_EQUALITY(found.size(), 1u);  // once for all its triangles
  if (found.size() != 1u) return;
  TEST_ASSERT(says(found[0], "Materials/rock/Poisson Ratio", "0.4901 with 3-node triangles in the body 'lower': above 0.49 they lock"));
  TEST_ASSERT(says(found[0], "Materials/rock/Poisson Ratio", "or choose Displacement there, or set Materials/rock/Allow Locking"));
  TEST_EQUALITY(problemsIn({nearly}, 1).size(), 0u);  // problems of steel
  TEST_EQUALITY(problemsIn({nearly, "Materials/rock/Allow Locking=true"}, 0).size(), 0u);
  TEST_EQUALITY(problemsIn({nearly, "Materials/rock/Element=Displacement"}, 0).size(), 0u);  // chosen by name
  const std::vector<Problem> mixed = problemsIn({"Materials/rock/Element=Mixed"}, 0);
  TEST_ASSERT(mixed.size() == 1u && says(mixed[0], "Materials/rock/Element", "no stable pressure"));
  Problems sheet;
  checkElements(
      block, [](int) { return 0; }, modelOf({nearly}), sheet);
  TEST_ASSERT(sheet.empty());  // plane stress
}

TEUCHOS_UNIT_TEST(ElasticModel, ChoosesElementsThatDoNotLock) {
  const auto chosen = [](const std::string& model, const std::string& poisson,
                         const std::string& setting = "Materials/rock/Young Modulus=1") {
    return modelOf({"Model=" + model, "Materials/rock/Poisson Ratio=" + poisson, setting}).materialOfBody[0].element;
  };
  for (const std::string model : {"Plane Strain", "Axisymmetric"}) {
    TEST_ASSERT(chosen(model, "0.4901") == ElementForm::Mixed);
    TEST_ASSERT(chosen(model, "0.49") == ElementForm::Displacement);
    TEST_ASSERT(chosen(model, "0.4901", "Materials/rock/Element=Displacement") == ElementForm::Displacement);
    TEST_ASSERT(chosen(model, "0.4901", "Materials/rock/Allow Locking=true") == ElementForm::Displacement);
    TEST_ASSERT(chosen(model, "0.3", "Materials/rock/Element=Mixed") == ElementForm::Mixed);
  }
  TEST_ASSERT(chosen("Plane Stress", "0.4999") == ElementForm::Displacement);
}

TEUCHOS_UNIT_TEST(ElasticModel, EnhancesElementsUnlessTheSceneNamesThem) {
  const auto enhanced = [](const std::string& element) {
    return modelOf({"Model=Plane Strain", "Materials/rock/Element=" + element}).materialOfBody[0].enhanced;
  };
  TEST_ASSERT(modelOf().materialOfBody[0].enhanced);
  TEST_ASSERT(enhanced("Automatic") && !enhanced("Displacement") && !enhanced("Mixed"));
  ElasticModel built;
  built.addBody("body", std::make_shared<GivenLaw>(isotropicStiffness({1.0, 0.3})));
  TEST_ASSERT(built.materialOfBody[0].enhanced);
}

TEUCHOS_UNIT_TEST(ElasticModel, WarnsOfDisplacementElementsNearIncompressibility) {
  const std::vector<std::string> nearly{"Model=Axisymmetric", "Materials/rock/Poisson Ratio=0.4999"};
  const auto notesWith = [&](const std::string& setting) {
    std::vector<std::string> overrides = nearly;
    overrides.push_back(setting);
    return lockingNotes(modelOf(overrides));
  };
  const std::vector<std::string> notes = notesWith("Materials/rock/Element=Displacement");
  TEST_EQUALITY(notes.size(), 1u);  // once, however many bodies
  TEST_ASSERT(!notes.empty() && notes[0].find("warning: Materials/rock: Poisson ratio 0.4999 with Element = Displacement") == 0);
  TEST_EQUALITY(lockingNotes(modelOf(nearly)).size(), 0u);
  TEST_EQUALITY(notesWith("Materials/rock/Element=Mixed").size(), 0u);
  TEST_EQUALITY(notesWith("Materials/rock/Allow Locking=true").size(), 1u);
  TEST_EQUALITY(lockingNotes(modelOf({"Materials/rock/Poisson Ratio=0.4999"})).size(), 0u);  // plane stress
  TEST_EQUALITY(lockingNotes(modelOf()).size(), 0u);
}

TEUCHOS_UNIT_TEST(ElasticModel, HasTheElasticityThatInvertsTheCompliance) {
  // Compliances are written straight from Hooke's law; only their inverses are in the code.
  const Material m{"m", 7.0, 0.3};
  const double e = m.young, nu = m.poisson;
  Eigen::Matrix3d stress, strain;
  stress << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
  strain << 1 - nu * nu, -nu * (1 + nu), 0, -nu * (1 + nu), 1 - nu * nu, 0, 0, 0, 2 * (1 + nu);
  TEST_COMPARE((elasticity(m, PlaneModel::Stress, 2) * stress / e - Eigen::Matrix3d::Identity()).norm(), <, 1e-14);
  TEST_COMPARE((elasticity(m, PlaneModel::Strain, 2) * strain / e - Eigen::Matrix3d::Identity()).norm(), <, 1e-14);
  Matrix solid = Matrix::Zero(6, 6);
  solid.topLeftCorner(3, 3).setConstant(-nu);
  solid.diagonal() << 1, 1, 1, 2 * (1 + nu), 2 * (1 + nu), 2 * (1 + nu);
  TEST_COMPARE((elasticity(m, PlaneModel::Strain, 3) * solid / e - Matrix::Identity(6, 6)).norm(), <, 1e-14);
}
