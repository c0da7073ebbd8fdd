#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/constraints/NodalRules.hpp>
#include <suture/constraints/PrescribedParts.hpp>

#include <Teuchos_ParameterList.hpp>

#include "ConstraintsTesting.hpp"

namespace {

using namespace constraintstesting;

const std::vector<LoadSteps::Named> conditions = {{"press", "Pressure"}, {"push", "Displacement"}, {"wall", "Bilateral"}};

LoadSteps steps(const std::vector<double>& times, const std::vector<std::pair<std::string, std::string>>& factors) {
  Parameters list("Load Steps");
  list.set("Times", Teuchos::Array<double>(times));
  list.set("Largest Change", 0.2);
  list.set("Halvings", 3);
  Parameters& own = list.sublist("Factors");
  for (const auto& [name, text] : factors) own.set(name, text);
  Constants constants{{"period", 4.0}};
  constants.functions.emplace("r", Expression("x + y"));
  return {list, conditions, constants};
}

template <typename Function>
std::string saidBy(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEUCHOS_UNIT_TEST(LoadSteps, FactorsAreExpressionsInTheTimeOrTables) {
  const LoadSteps path = steps({1, 2, 4}, {{"press", "sin(2*pi*t/period)"}, {"push", "{0.5, 1, -1}"}});
  TEST_EQUALITY(path.factors(), 3);
  TEST_EQUALITY(path.factorOf("wall"), 0);
  const auto at = [&](double time, const char* name) { return path.at(time)[std::size_t(path.factorOf(name))]; };
  TEST_FLOATING_EQUALITY(at(1, "press"), 1.0, 1e-15);
  TEST_FLOATING_EQUALITY(at(0.5, "press"), std::sqrt(0.5), 1e-15);
  const std::pair<double, double> table[] = {{0.5, 0.25}, {1, 0.5}, {1.5, 0.75}, {2, 1}, {3, 0}, {4, -1}};
  for (const auto& [time, value] : table) TEST_FLOATING_EQUALITY(1.0 + at(time, "push"), 1.0 + value, 1e-15);
  for (const double time : {0.5, 4.0}) TEST_EQUALITY(at(time, "wall"), 1.0);
}

TEUCHOS_UNIT_TEST(LoadSteps, ConditionsWithOneFunctionShareAFactor) {
  const LoadSteps path = steps({1}, {{"press", "t^2"}, {"push", " t^2 "}});
  TEST_EQUALITY(path.factors(), 2);
  TEST_EQUALITY(path.factorOf("press"), path.factorOf("push"));
}

TEUCHOS_UNIT_TEST(LoadSteps, NameAllThatIsWrong) {
  const auto made = [](const std::vector<double>& times, const std::vector<std::pair<std::string, std::string>>& factors) {
    return [=] { steps(times, factors); };
  };
  const std::string all = saidBy(made({1, 1}, {{"pres", "t"}, {"wall", "t"}, {"push", "{1}"}, {"press", "x"}}));
  for (const char* part : {"Times", "expected ascending times above 0", "'pres'", "Did you mean 'press'?", "a Bilateral", "no amount",
                           "expected a number for each of the 2", "unknown: 'x'", "Variables: t"})
    SUTURE_CHECK_SAYS(all, part);
  SUTURE_CHECK_SAYS(saidBy(made({}, {{"press", "t"}})), "is empty");
  SUTURE_CHECK_SAYS(saidBy(made({1}, {{"press", "{1, a}"}})), "expected a number");
}

TEUCHOS_UNIT_TEST(LoadSteps, APoleOfAFactorIsNamedWithItsTime) {
  const LoadSteps path = steps({1, 2}, {{"press", "1/(t-2)"}});
  TEST_FLOATING_EQUALITY(path.at(1)[1], -1.0, 1e-15);
  SUTURE_CHECK_SAYS(saidBy([&] { path.at(2); }), "infinite at t = 2");
}

/// A square whose right side is moved along x by one condition and along y by another, its top along y by a third.
std::vector<Condition> moved(int along, int across, int top, double value = 0.5) {
  std::vector<Condition> all{Condition::displacement("b0_right", {2}, {0}), Condition::displacement("b0_right", {value}, {1}),
                             Condition::displacement("b0_top", {0.5}, {1})};
  const int factors[] = {along, across, top};
  for (int i = 0; i < 3; ++i) all[i].factor = factors[i], all[i].name = std::string(1, char('a' + i));
  return all;
}

TEUCHOS_UNIT_TEST(LoadSteps, PrescribedValuesAreSumsOverFactors) {
  const Mesh mesh = stack(1);
  Problems problems;
  std::vector<Support> supports;
  std::vector<std::vector<RuleValue>> parts;
  const std::vector<NodeRule> rules = nodalRules(mesh, moved(1, 2, 2), problems, supports, parts);
  problems.throwIfAny();
  TEST_EQUALITY(parts.size(), 3u);
  TEST_ASSERT(parts[0].empty());
  for (const NodeRule& rule : rules) {
    Point sum{0, 0, 0};
    for (const auto& ofFactor : parts)
      for (const RuleValue& part : ofFactor)
        if (part.node == rule.node) sum = plus(sum, part.value);
    TEST_COMPARE(norm(minus(sum, rule.value)), <, 1e-15);
  }
  for (const RuleValue& part : parts[1]) TEST_ASSERT(part.value == (Point{2, 0, 0}));
  nodalRules(mesh, moved(0, 0, 0), problems, supports, parts);
  TEST_ASSERT(parts.empty());
}

TEUCHOS_UNIT_TEST(LoadSteps, ConditionsThatMeetMustAgreeAtAllTimes) {
  const Mesh mesh = stack(1);
  std::vector<Support> supports;
  std::vector<std::vector<RuleValue>> parts;
  const auto contradict = [&](const std::vector<Condition>& conditions) {
    Problems problems;
    nodalRules(mesh, conditions, problems, supports, parts);
    return [problems] { problems.throwIfAny(); };
  };
  contradict(moved(1, 2, 2))();  // where b and c meet they are equal at all times
  SUTURE_CHECK_SAYS(saidBy(contradict(moved(1, 2, 1))), "Load Steps/Factors");
  SUTURE_CHECK_SAYS(saidBy(contradict(moved(1, 2, 2, 0.25))), "'b' makes it 0.25");
}

}  // namespace
