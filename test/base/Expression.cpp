#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/scene/SceneReader.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

namespace {

using namespace suture;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string messageOf(const std::string& text, const Constants& constants = {}) {
  try {
    Expression(text, constants, "Load/Expression x");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(Expression, AgreesWithTheSameFormulaInCpp) {
  const Constants constants{{"A", -2.5}, {"kappa", 1.8}};
  const Expression f("A * sqrt(x^2 + y^2)^1.5 * ((kappa + 1/2) * cos(1.5*atan2(y, x)) - 3/2*cos(atan2(y, x)/2))", constants);
  for (const double x : {-0.7, 0.0, 1.3})
    for (const double y : {0.2, 0.9}) {
      const double r = std::hypot(x, y), t = std::atan2(y, x);
      const double expected = -2.5 * std::pow(r, 1.5) * ((1.8 + 0.5) * std::cos(1.5 * t) - 1.5 * std::cos(0.5 * t));
      TEST_FLOATING_EQUALITY(f.at({x, y, 0}), expected, 1e-14);
    }
}

TEUCHOS_UNIT_TEST(Expression, BindsItsOperatorsAsMathematiciansDo) {
  TEST_EQUALITY(Expression("-x^2").at({3, 0, 0}), -9.0);
  TEST_EQUALITY(Expression("2^3^2").at({0, 0, 0}), 512.0);
  TEST_EQUALITY(Expression("1 - 2 - 3").at({0, 0, 0}), -4.0);
  TEST_EQUALITY(Expression("12 / 2 / 3").at({0, 0, 0}), 2.0);
  TEST_EQUALITY(Expression("x < 0 ? -1 : x == 0 ? 0 : 1").at({0, 0, 0}), 0.0);
  TEST_EQUALITY(Expression("pi").at({0, 0, 0}), std::acos(-1.0));
}

TEUCHOS_UNIT_TEST(Expression, BranchesThatAreNotTakenMayBeUndefined) {
  TEST_EQUALITY(Expression("x > 0 ? sqrt(x) : 0").at({-4, 0, 0}), 0.0);
}

TEUCHOS_UNIT_TEST(Expression, CopiesDoNotDisturbEachOther) {
  const Expression f("x + 10*y"), g = f;
  TEST_EQUALITY(f.at({1, 2, 0}), 21.0);
  TEST_EQUALITY(g.at({3, 4, 0}), 43.0);
  TEST_EQUALITY(f.at({1, 2, 0}), 21.0);
}

TEUCHOS_UNIT_TEST(Expression, ReportsAllUnknownNamesWithTheNearest) {
  const std::string text = messageOf("lamda * x + sqt(y) - q", {{"lambda", 1.0}});
  TEST_ASSERT(has(text, "Load/Expression x: "));
  TEST_ASSERT(has(text, "'lamda' (did you mean 'lambda'?)"));
  TEST_ASSERT(has(text, "'sqt' (did you mean 'sqrt'?)"));
  TEST_ASSERT(has(text, "'q'"));
  TEST_ASSERT(has(text, "Variables: x, y. Constants: lambda, pi. Functions: abs, acos"));
}

TEUCHOS_UNIT_TEST(Expression, ReportsThePlaceOfASyntaxError) {
  TEST_ASSERT(has(messageOf("2*(x"), "at character 5 (the end)"));
  TEST_ASSERT(has(messageOf("x y"), "at character 3 ('y')"));
  TEST_ASSERT(has(messageOf("x ** 2"), "at character 4 ('* 2')"));
  TEST_ASSERT(has(messageOf("sin(x, y)"), "Too many parameters"));
  TEST_ASSERT(has(messageOf("sin x"), "the function sin needs its arguments in parentheses"));
  TEST_ASSERT(has(messageOf("x, y"), "has 2 values separated by commas"));
  TEST_ASSERT(has(messageOf("x = 3"), "'=' at character 3: to compare, write =="));
  TEST_ASSERT(has(messageOf(" "), "is empty"));
  for (const char* bad : {"1e", "x#", "é", "!x", "\"a\"", "x +", ") x", "0x10", "a.b"}) TEST_INEQUALITY(messageOf(bad), "");
}

TEUCHOS_UNIT_TEST(Expression, ReportsWhereItsValueIsNotFinite) {
  const Expression f("1 / (x - y)", {}, "Load/Expression x");
  TEST_EQUALITY(f.at({3, 1, 0}), 0.5);
  try {
    f.at({0.25, 0.25, 0});
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_EQUALITY(std::string(error.what()), "Load/Expression x: '1 / (x - y)' is infinite at (x, y) = (0.25, 0.25)");
  }
  TEST_THROW(Expression("sqrt(x)").at({-1, 0, 0}), InputError);
  TEST_THROW(Expression("ln(x)").at({-1, 0, 0}), InputError);
}

Parameters parametersOf(const std::string& inside) {
  return *parseScene("<ParameterList>" + inside + "</ParameterList>", "scene.xml",
                     Schema().list("Constants", constantsSchema()).text("Gap", std::nullopt, "an expression").optional())
              .parameters;
}

TEUCHOS_UNIT_TEST(Constants, AreKnownToTheExpressionsOfTheScene) {
  const Parameters list = parametersOf(R"xml(<ParameterList name="Constants"><Parameter name="R" type="double" value="8"/></ParameterList>
    <Parameter name="Gap" type="string" value="x &lt; R ? R - sqrt(R^2 - x^2) : R"/>)xml");
  Problems problems;
  const Constants constants = readConstants(list.sublist("Constants"), problems);
  const auto gap = readExpression(list, "Gap", constants, problems);
  problems.throwIfAny();
  TEST_FLOATING_EQUALITY(gap->at({2, 0, 0}), 8 - std::sqrt(60.0), 1e-14);
  TEST_ASSERT(!readExpression(list, "Other", constants, problems) && problems.empty());
}

TEUCHOS_UNIT_TEST(Constants, WithNamesThatNoExpressionCanUseAreProblems) {
  const Parameters list = parametersOf(R"xml(<ParameterList name="Constants"><Parameter name="E star" type="double" value="1"/>
    <Parameter name="x" type="double" value="1"/><Parameter name="sin" type="double" value="1"/></ParameterList>
    <Parameter name="Gap" type="string" value="R"/>)xml");
  Problems problems;
  TEST_ASSERT(readConstants(list.sublist("Constants"), problems).numbers.empty());
  TEST_EQUALITY(problems.list().size(), 3);
  TEST_ASSERT(!readExpression(list, "Gap", {}, problems));
  TEST_EQUALITY(problems.list().back().path, "Gap");
}

TEUCHOS_UNIT_TEST(Functions, MayBeUsedInOtherFunctions) {
  const SceneFile file = parseScene(R"xml(<ParameterList>
    <ParameterList name="Constants"><Parameter name="E" value="2"/><Parameter name="nu" value="0.25"/></ParameterList>
    <ParameterList name="Functions"><Parameter name="mu" value="E/(2*(1 + nu))"/><Parameter name="r" value="sqrt(x^2 + y^2)"/>
      <Parameter name="root" value="sqrt(r - 1)"/></ParameterList></ParameterList>)xml",
                                    "scene.xml", Schema().list("Constants", constantsSchema()).list("Functions", functionsSchema()));
  const Constants constants = sceneConstants(*file.parameters);
  TEST_EQUALITY(constants.functions.size(), 3u);
  const Expression f("r > 1 ? mu*root + x : y", constants);
  TEST_FLOATING_EQUALITY(f.at({3, 4, 0}), 0.8 * 2 + 3, 1e-14);
  TEST_EQUALITY(f.at({0.3, 0.4, 0}), 0.4);  // root is not defined there, nor needed
  const Expression copy = f;
  TEST_FLOATING_EQUALITY(copy.at({0, 2, 0}), 0.8, 1e-14);
  TEST_THROW(Expression("root", constants).at({0, 0, 0}), InputError);
}

TEUCHOS_UNIT_TEST(Functions, KnowOnlyThoseAboveThem) {
  const SceneFile file = parseScene(R"xml(<ParameterList>
    <ParameterList name="Constants"><Parameter name="E" value="2"/></ParameterList>
    <ParameterList name="Functions"><Parameter name="a" value="2*bb"/><Parameter name="bb" value="bb + 1"/>
      <Parameter name="E" value="3"/><Parameter name="c" value="E*x"/></ParameterList></ParameterList>)xml",
                                    "scene.xml", Schema().list("Constants", constantsSchema()).list("Functions", functionsSchema()));
  try {
    sceneConstants(*file.parameters);
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_EQUALITY(error.problems().size(), 3u);
    TEST_EQUALITY(error.problems()[0].path, "Functions/a");
    TEST_EQUALITY(error.problems()[1].path, "Functions/bb");
    TEST_EQUALITY(error.problems()[2].path, "Functions/E");
  }
}

TEUCHOS_UNIT_TEST(Expression, MayBeAFunctionOfTheProgram) {
  const Expression f([](const Point& p) { return 1.0 / (p[0] - 2 * p[1] + p[2]); });
  TEST_EQUALITY(f.at({3, 1, 1}), 0.5);
  const Expression copy = f;
  TEST_EQUALITY(copy.at({0, 0, 4}), 0.25);
  try {
    f.at({2, 1, 0});
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_EQUALITY(error.problems()[0].message, "'a function of the program' is infinite at (x, y) = (2, 1)");
  }
}

}  // namespace

// In 3D an expression depends on three coordinates; in 2D z is a name like any other.
TEUCHOS_UNIT_TEST(Expression, HasZIn3DOnly) {
  Constants space;
  space.dimension = 3;
  const Expression f("x + 10*y + 100*z", space);
  TEST_EQUALITY(f.at({1, 2, 3}), 321.0);
  TEST_EQUALITY(f.at({4, 5, 6}), 654.0);
  TEST_THROW(Expression("x + z"), InputError);
  TEST_EQUALITY(Expression("x + z", Constants{{"z", 5.0}}).at({1, 0, 3}), 6.0);
  try {
    Expression("1/z", space, "somewhere").at({1, 2, 0});
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_ASSERT(std::string(error.what()).find("'1/z' is infinite at (x, y, z) = (1, 2, 0)") != std::string::npos);
  }
}
