#include <suture/base/Errors.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace {

using namespace suture;

const std::vector<std::string> names{"Tolerance", "Type", "Maximum Iterations", "Young Modulus"};

TEUCHOS_UNIT_TEST(Errors, NearestNameForgivesASlipOfTheHand) {
  TEST_EQUALITY(nearestName("Tolerence", names), "Tolerance");
  TEST_EQUALITY(nearestName("toleranec", names), "Tolerance");  // two letters swapped, case ignored
  TEST_EQUALITY(nearestName("Typ", names), "Type");
  TEST_EQUALITY(nearestName("Maximum Iteration", names), "Maximum Iterations");
}

TEUCHOS_UNIT_TEST(Errors, NearestNameTakesABeginningForTheWhole) { TEST_EQUALITY(nearestName("young", names), "Young Modulus"); }

TEUCHOS_UNIT_TEST(Errors, NearestNameIsSilentWhenNothingIsNear) {
  TEST_EQUALITY(nearestName("Poisson", names), "");
  TEST_EQUALITY(nearestName("", names), "");
  TEST_EQUALITY(nearestName("Type", {}), "");
}

TEUCHOS_UNIT_TEST(Errors, NearestNamePrefersTheNearest) {
  TEST_EQUALITY(nearestName("left_sode", {"left_slide", "left_side"}), "left_side");
}

TEUCHOS_UNIT_TEST(Errors, UnknownNameListsTheKnownOnesInOrder) {
  TEST_EQUALITY(unknownName("curve group", "botom", {"top", "bottom"}),
                "no such curve group 'botom'. Did you mean 'bottom'? Known here: bottom, top");
  TEST_EQUALITY(unknownName("body", "x", {}), "no such body 'x'. None are known here.");
}

TEUCHOS_UNIT_TEST(Errors, JoinNamesCutsLongLists) {
  TEST_EQUALITY(joinNames({"a", "b", "c"}, 3), "a, b, c");
  TEST_EQUALITY(joinNames({"a", "b", "c"}, 2), "a, b ... (3 in all)");
}

TEUCHOS_UNIT_TEST(Errors, InputErrorPrintsOneLinePerProblem) {
  const InputError error(std::vector<Problem>{{"a/b", "is wrong"}, {"", "so is all"}});
  TEST_EQUALITY(std::string(error.what()), "a/b: is wrong\nso is all");
  TEST_ASSERT(error.code() == ExitCode::Input);
  TEST_EQUALITY(error.problems().size(), 2u);
}

TEUCHOS_UNIT_TEST(Errors, ProblemsThrowOnlyIfThereAreAny) {
  Problems problems;
  TEST_NOTHROW(problems.throwIfAny());
  problems.add("a", "b");
  TEST_THROW(problems.throwIfAny(), InputError);
}

TEUCHOS_UNIT_TEST(Errors, EveryKindHasItsExitCode) {
  TEST_EQUALITY(static_cast<int>(CommandLineError("").code()), 2);
  TEST_EQUALITY(static_cast<int>(InputError("", "").code()), 3);
  TEST_EQUALITY(static_cast<int>(NumericalError("").code()), 4);
  TEST_EQUALITY(static_cast<int>(EnvironmentError("").code()), 5);
  TEST_EQUALITY(static_cast<int>(InternalError("").code()), 70);
}

TEUCHOS_UNIT_TEST(Errors, AreCutWhereAValueIsLong) {
  const std::string large(100000, 'x'), blanks(1000, ' ');
  const std::string said = InputError("Bodies/" + large, "'" + large + "' is no number, '" + blanks + "' neither; it isn't short").what();
  TEST_COMPARE(said.size(), <, 1000);
  TEST_INEQUALITY(said.find("xxx... (100000 characters)' is no number"), std::string::npos);
  TEST_INEQUALITY(said.find("   ... (1000 characters)' neither; it isn't short"), std::string::npos);
  TEST_INEQUALITY(said.find("Bodies/" + std::string(100, 'x')), std::string::npos);
  TEST_COMPARE(std::string(EnvironmentError("a\n" + std::string(200, 'y') + "\n" + large).what()).size(), <, 500);
  TEST_EQUALITY(shortened(said), said);  // a message may pass through several errors
  // Short words are kept, in any number, up to a line of 4000 characters.
  std::string names;
  for (int i = 0; i < 300; ++i) names += "group_" + std::to_string(i) + ", ";
  TEST_EQUALITY(shortened(names), names);
  TEST_EQUALITY(shortened("a's " + std::string(190, 'b') + " c's"), "a's " + std::string(190, 'b') + " c's");
  const std::string umlauts = "'" + [] {
    std::string all;
    for (int i = 0; i < 300; ++i) all += "\xC3\xA4";
    return all;
  }() + "'";
  TEST_EQUALITY(shortened(umlauts), umlauts.substr(0, 201) + "... (600 characters)'");
}

}  // namespace
