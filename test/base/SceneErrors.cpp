// All possible errors of a scene file, and the traps of Teuchos' own reader (doc/numerics.md): each is an error here.
#include <Teuchos_UnitTestHarness.hpp>
#include <base/SceneTexts.hpp>

namespace {

using namespace suture;
using namespace suture::scenes;

TEUCHOS_UNIT_TEST(SceneErrors, RefusesTextForAnInt) {
  for (const std::string bad : {"abc", "3.7", "", "5x", "99999999999", "1e2"}) {
    TEST_ASSERT(
        contains(errorOfSolver(parameter("Maximum Iterations", "int", bad)), "Outer Solver/Maximum Iterations: '" + bad + "' is not"));
    TEST_ASSERT(contains(errorOfSolver(parameter("Maximum Iterations", "", bad)),
                         "Outer Solver/Maximum Iterations: '" + bad + "' is not an integer: expected an integer, >= 1"));
  }
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesTextForADouble) {
  for (const std::string bad : {"1e-8x", "", "nan", "inf", "-inf", "1e999", "1,5", "{1}"})
    TEST_EQUALITY(errorOfSolver(parameter("Tolerance", "double", bad)),
                  "Outer Solver/Tolerance: '" + bad + "' is not a (finite) number: expected a number, > 0");
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesDuplicates) {
  const std::string twice = parameter("Tolerance", "double", "1e-6") + parameter("Tolerance", "double", "1e-8");
  TEST_EQUALITY(errorOfSolver(twice), "Outer Solver/Tolerance: is given twice; remove one of them");
  TEST_EQUALITY(errorOf(scene(list("Load", "") + list("Load", ""))), "Load: is given twice; remove one of them");
  TEST_EQUALITY(errorOf(scene(body)), "Bodies: is given twice; remove one of them");
  TEST_ASSERT(contains(errorOf(scene(list("Load", "") + parameter("Load", "int", "1"))), "Load: is given twice"));
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesMalformedXmlWithTheLine) {
  TEST_ASSERT(contains(errorOf("<ParameterList name=\"Suture\">\n\n</Parameter>"), "dir/scene.xml: this is not valid XML: line 3: "));
  for (const char* bad :
       {"<ParameterList>", "<ParameterList", "</ParameterList>", "<ParameterList/></ParameterList>", "<ParameterList/><ParameterList/>",
        "<ParameterList a='1' a='2'/>", "<ParameterList name=\"a<b\"/>", "<ParameterList>&nosuch;</ParameterList>", "<ParameterList/> junk",
        "junk", "<!-- ", "<ParameterList><!-- </ParameterList>", "<", "<?xml", "<ParameterList name=\"x/>"})
    TEST_ASSERT(contains(errorOf(bad), "dir/scene.xml: this is not valid XML: line 1: "));
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesAnEmptyFile) {
  TEST_EQUALITY(errorOf(""), "dir/scene.xml: the file is empty");
  TEST_EQUALITY(errorOf(" \n\t "), "dir/scene.xml: the file is empty");
  TEST_ASSERT(errorOf("<!-- nothing but a remark -->") != "");
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesXmlWithoutAParameterList) {
  TEST_EQUALITY(errorOf("<html/>"), "dir/scene.xml: the outermost element must be <ParameterList>, found <html>");
  TEST_ASSERT(contains(errorOf(scene("<Paramter name=\"Title\" value=\"x\"/>")), "no such element <Paramter>. Did you mean 'Parameter'?"));
  TEST_ASSERT(contains(errorOf(scene("stray")), "text outside of any attribute: 'stray'"));
  TEST_ASSERT(contains(errorOfSolver("<Parameter name=\"Tolerance\" vlaue=\"1\"/>"), "Outer Solver/Tolerance: has no attribute 'value'"));
  TEST_ASSERT(contains(errorOfSolver("<Parameter value=\"1\"/>"), "Outer Solver: a parameter without the attribute name"));
  TEST_ASSERT(contains(errorOf(scene(list("Constants", parameter("a/b", "double", "1")))), "Constants: the name 'a/b' contains '/'"));
}

// Schema ----------------------------------------------------------------------------------------------------------------------------

TEUCHOS_UNIT_TEST(SceneErrors, NamesTheNearestForAnUnknownParameter) {
  TEST_EQUALITY(errorOfSolver(parameter("Tolerence", "double", "1e-8")),
                "Outer Solver/Tolerence: no such parameter. Did you mean 'Tolerance'? Known here: Maximum Iterations, Tolerance, Type");
}

TEUCHOS_UNIT_TEST(SceneErrors, NamesTheListOfAMisplacedParameter) {
  TEST_ASSERT(contains(errorOfSolver(parameter("Inner Tolerance", "double", "1")), "A parameter of this name exists in Newton"));
}

TEUCHOS_UNIT_TEST(SceneErrors, NamesTheNearestForAnUnknownList) {
  TEST_EQUALITY(errorOf(scene(list("Outer Sover", ""))),
                "Outer Sover: no such list. Did you mean 'Outer Solver'? Known here: Bodies, Constants, Load, Material, Outer Solver");
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesAListForAParameterAndTheReverse) {
  TEST_EQUALITY(errorOf(scene(parameter("Outer Solver", "string", "Chord"))), "Outer Solver: is a list of parameters, not a parameter");
  TEST_EQUALITY(errorOf(scene(list("Title", ""))), "Title: is a parameter, not a list: expected a text");
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesAWrongType) {
  TEST_EQUALITY(errorOfSolver(parameter("Maximum Iterations", "double", "3")),
                "Outer Solver/Maximum Iterations: is of type double ('3'), expected type int: an integer, >= 1");
  TEST_ASSERT(contains(errorOf(scene(parameter("Title", "bool", "true"))), "Title: is of type bool ('true'), expected type string"));
  TEST_ASSERT(contains(errorOf(scene(parameter("Model", "int", "3"))), "Model: is of type int ('3'), expected type string"));
  TEST_ASSERT(contains(errorOf(scene(parameter("Title", "double", "3 x"))), "Title: '3 x' is not of its type double"));
  TEST_ASSERT(contains(errorOfSolver(parameter("Tolerance", "flaot", "3")), "Outer Solver/Tolerance: no such type 'flaot'"));
  TEST_ASSERT(contains(errorOf(scene(parameter("Check", "bool", "maybe"))), "Check: 'maybe' is not a boolean: expected true or false"));
  TEST_ASSERT(
      contains(errorOf(scene(list("Load", parameter("Value", "Array(double)", "{1, x}")))), "Load/Value: 'x' is not a (finite) number"));
  TEST_ASSERT(contains(errorOf(scene(list("Load", parameter("Value", "Array(double)", "{1, 2")))), "Load/Value: '{1, 2' cannot be read"));
  TEST_ASSERT(contains(errorOf(scene(list("Load", parameter("Value", "Array(int)", "{1.5}")))),
                       "Load/Value: '{1.5}' is not of its type Array(int)"));
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesValuesOutOfRangeWithTheReason) {
  TEST_EQUALITY(errorOf(scene(list("Material", parameter("Poisson Ratio", "double", "0.5")))),
                "Material/Poisson Ratio: 0.5 is not below 0.5, it must lie in (-1, 0.5) (an incompressible body needs a mixed element)");
  TEST_EQUALITY(errorOfSolver(parameter("Tolerance", "double", "0")), "Outer Solver/Tolerance: 0 is not above 0");
  TEST_EQUALITY(errorOfSolver(parameter("Maximum Iterations", "int", "0")), "Outer Solver/Maximum Iterations: 0 is not at least 1");
  TEST_EQUALITY(errorOf(scene(list("Load", parameter("Nodes", "Array(int)", "{1, -2}")))), "Load/Nodes: -2 is not at least 0");
}

TEUCHOS_UNIT_TEST(SceneErrors, RefusesANameThatIsNotAllowed) {
  TEST_EQUALITY(errorOf(scene(parameter("Model", "string", "Plain Strain"))),
                "Model: no such name 'Plain Strain'. Did you mean 'Plane Strain'? Known here: Plane Strain, Plane Stress");
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Cord")),
                "Outer Solver/Type: no such name 'Cord'. Did you mean 'Chord'? Known here: Chord, Newton, Successive Approximation");
}

TEUCHOS_UNIT_TEST(SceneErrors, ChecksTheListsOfChoicesNotTaken) {
  TEST_EQUALITY(errorOfSolver(list("Chord", parameter("Depht", "int", "3"))),
                "Outer Solver/Chord/Depht: no such parameter. Did you mean 'Depth'? Known here: Depth");
  TEST_EQUALITY(errorOfSolver(list("Chord", parameter("Depth", "int", "-3"))), "Outer Solver/Chord/Depth: -3 is not at least 0");
}

TEUCHOS_UNIT_TEST(SceneErrors, RequiresTheParametersOfTheChoice) {
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Chord")),
                "Outer Solver/Chord/Depth: is missing and has no default: of Anderson (expected an integer, >= 0)");
  TEST_EQUALITY(errorOfSolver(parameter("Type", "string", "Chord") + list("Chord", parameter("Depth", "int", "3"))), "");
}

TEUCHOS_UNIT_TEST(SceneErrors, DemandsRequiredListsAndParameters) {
  TEST_EQUALITY(errorOf("<ParameterList name=\"Suture\"/>"), "Bodies: this list is missing: all bodies");
  TEST_EQUALITY(errorOf("<ParameterList name=\"Suture\"><ParameterList name=\"Bodies\"/></ParameterList>"),
                "Bodies: has 0 lists <body>, expected at least 1: one body");
  TEST_EQUALITY(
      errorOf("<ParameterList name=\"Suture\"><ParameterList name=\"Bodies\"><ParameterList name=\"b\"/></ParameterList></ParameterList>"),
      "Bodies/b/Material: is missing and has no default: name of a material (expected a text)");
}

TEUCHOS_UNIT_TEST(SceneErrors, ReportsEverythingAtOnce) {
  const std::string text = scene(parameter("Titel", "string", "x") + list("Material", parameter("Poisson Ratio", "double", "0.7")) +
                                 list("Outer Solver", parameter("Tolerance", "double", "1e-8") + parameter("Tolerance", "double", "1e-8") +
                                                          parameter("Maximum Iterations", "int", "many")) +
                                 list("Loads", ""));
  std::vector<std::string> paths;
  try {
    parse(text, {"Check", "Load/Value=x"});
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) paths.push_back(problem.path);
  }
  std::sort(paths.begin(), paths.end());
  TEST_ASSERT((paths == std::vector<std::string>{"--set", "Load/Value", "Loads", "Material/Poisson Ratio",
                                                 "Outer Solver/Maximum Iterations", "Outer Solver/Tolerance", "Titel"}));
}

}  // namespace
