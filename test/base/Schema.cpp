#include <support/Texts.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/base/scene/SchemaDocument.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>

namespace {

using namespace suture;
using texts::contains;

Schema solver() {
  return Schema("outer (contact) iterations")
      .real("Tolerance", 1e-8, "where to stop", Range::positive())
      .integer("Maximum Iterations", 50, "then --give up--", Range::atLeast(1))
      .wordOrNumber("Relaxation", "Automatic", {"None", "Automatic"}, Range::positive(), "length of a step")
      .reals("Gravity", std::vector<double>{0.0, -9.81}, "acceleration", "length/time^2")
      .text("Name <of> \"it\"", "a & b", "needs escapes")
      .choice("Type", "Newton", {{"Newton", Schema("full steps").real("Inner Tolerance", 1e-2, "relative")}, {"Chord", Schema("majorant")}},
              "the method");
}

TEUCHOS_UNIT_TEST(Schema, RangePrintsItsInterval) {
  TEST_EQUALITY(Range::any().text(), "any");
  TEST_EQUALITY(Range::positive().text(), "> 0");
  TEST_EQUALITY(Range::atLeast(1).text(), ">= 1");
  TEST_EQUALITY((Range{0.0, 0.5, false, true, {}}).text(), "in [0, 0.5)");
  TEST_EQUALITY((Range{-std::numeric_limits<double>::infinity(), 2.0, false, false, {}}).text(), "<= 2");
}

TEUCHOS_UNIT_TEST(Schema, RefusesANameThatIsTaken) {
  TEST_THROW(Schema().real("A", 1.0, "").text("A", "", ""), InternalError);
  TEST_THROW(Schema().real("A", 1.0, "").list("A", Schema()), InternalError);
  TEST_THROW(Schema().real("A/B", 1.0, ""), InternalError);
}

TEUCHOS_UNIT_TEST(Schema, ParametersOfAChoiceMayBeNextToIt) {
  const Schema laws = Schema().choice(
      "Type", "Plain",
      {{"Plain", Schema("one number").real("Modulus", std::nullopt, "stiffness")}, {"Rich", Schema("many").real("Angle", 0.0, "turn")}},
      "the law", "Plain");
  const auto errorOf = [&](const std::string& inside) -> std::string {
    try {
      parseScene("<ParameterList name=\"Suture\">" + inside + "</ParameterList>", "laws.xml", laws);
    } catch (const InputError& error) {
      return error.problems().front().path + ": " + error.problems().front().message;
    }
    return "";
  };
  const std::string modulus = "<Parameter name=\"Modulus\" type=\"double\" value=\"2\"/>",
                    rich = "<Parameter name=\"Type\" type=\"string\" value=\"Rich\"/>";
  TEST_EQUALITY(errorOf(modulus), "");
  TEST_EQUALITY(errorOf(""), "Modulus: is missing and has no default: stiffness (expected a number)");
  TEST_EQUALITY(errorOf(rich), "");            // not required by another choice
  TEST_EQUALITY(errorOf(rich + modulus), "");  // nor refused, like lists of other choices
  TEST_ASSERT(documentOf(laws, "text").find("Modulus  (double, required with Type Plain) stiffness") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Schema, RefusesADefaultThatIsNotAllowed) { TEST_THROW(Schema().oneOf("A", "z", {"x", "y"}, ""), InternalError); }

TEUCHOS_UNIT_TEST(Schema, DocumentsInTextDefaultUnitRangeNamesAndMeaning) {
  const std::string text = documentOf(solver(), "text");
  TEST_ASSERT(contains(text, "Tolerance  (double, default 1e-08, > 0) where to stop"));
  TEST_ASSERT(contains(text, "length/time^2"));
  TEST_ASSERT(contains(text, "None | Automatic | number > 0"));
  TEST_ASSERT(contains(text, "Chord | Newton"));
  TEST_ASSERT(contains(text, "Newton: full steps"));
  TEST_ASSERT(contains(text, "Inner Tolerance  (double, default 0.01) relative"));
}

TEUCHOS_UNIT_TEST(Schema, DocumentsInMarkdownWithBarsEscaped) {
  const std::string text = documentOf(solver(), "markdown");
  TEST_ASSERT(contains(text, "| Tolerance | double | 1e-08 | > 0 |"));
  TEST_ASSERT(contains(text, "Chord \\| Newton"));
  TEST_ASSERT(contains(text, "## Newton"));
}

TEUCHOS_UNIT_TEST(Schema, DocumentInXmlIsASceneThatReadsBackAsTheDefaults) {
  const Schema schema =
      Schema("scene")
          .list("Outer Solver", solver())
          .list("Bodies", Schema("all").each("body", Schema("one").text("Material", std::nullopt, "its -- name").optional()))
          .list("Constants", Schema("of Gmsh").eachReal("name", "any"));
  const SceneFile defaults = parseScene("<ParameterList name=\"Suture\"/>", "empty", schema);
  const SceneFile documented = parseScene(documentOf(schema, "xml"), "documented", schema);
  TEST_EQUALITY(toXml(*documented.parameters), toXml(*defaults.parameters));
  TEST_EQUALITY(documented.parameters->sublist("Outer Solver").get<std::string>("Name <of> \"it\""), "a & b");
}

TEUCHOS_UNIT_TEST(Schema, DocumentInXmlHasTheExamplesListsAndValues) {
  const Schema schema =
      Schema("scene")
          .list("Outer Solver", solver())
          .list("Bodies", Schema("all").each("body", Schema("one").text("Material", std::nullopt, "its name").real("Size", 1.0, "of it")));
  const std::string text = documentOf(
      schema, "xml", {{"Outer Solver/Tolerance", "1e-3"}, {"Bodies/upper/Material", "steel"}, {"Bodies/lower/Material", "rock"}});
  const SceneFile documented = parseScene(text, "documented", schema);
  TEST_EQUALITY(documented.parameters->sublist("Outer Solver").get<double>("Tolerance"), 1e-3);
  const Parameters& bodies = documented.parameters->sublist("Bodies");
  TEST_EQUALITY(bodies.sublist("upper").get<std::string>("Material"), "steel");
  TEST_EQUALITY(bodies.sublist("lower").get<std::string>("Material"), "rock");
  TEST_EQUALITY(bodies.sublist("lower").get<double>("Size"), 1.0);
  TEST_ASSERT(contains(text, "&lt;body&gt;"));
}

TEUCHOS_UNIT_TEST(Schema, RefusesAnUnknownFormatWithTheKnownOnes) {
  TEST_THROW(documentOf(solver(), "html"), CommandLineError);
  try {
    documentOf(solver(), "markdwn");
  } catch (const CommandLineError& error) {
    TEST_ASSERT(contains(error.what(), "Did you mean 'markdown'?"));
  }
}

}  // namespace
