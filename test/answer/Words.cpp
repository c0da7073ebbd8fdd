// Sentences assembled from parts: each of their branches is checked once.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/answer/solvability/NeutralMotions.hpp>
#include <suture/answer/verdict/Findings.hpp>
#include <suture/answer/verdict/Verification.hpp>
#include <suture/motion/RigidMotion.hpp>

#include <regex>

namespace suture {
namespace {

/// Faults of a sentence: repeated words, two prepositions, two punctuation marks, unfilled placeholders.
std::string faultOf(const std::string& text) {
  static const std::regex wrong(
      R"(\b(a|the|at|on|in|of|to|by|with|and|or|is) \1\b|\b(at|of|to|by|from|with) (at|on|in|of|by|from|with)\b| \(\)| [,;.]( |$)|[,;:] ?[,;:.]( |$)|  |\bnan\b|\binf\b|''|-0[,) ])");
  std::smatch found;
  return std::regex_search(text, found, wrong) ? found.str() + "' in '" + text : "";
}

RigidPart bodyAt(const Point& centre, double radius) {
  RigidPart part;
  part.body = 0;
  part.centre = centre;
  part.radius = radius;
  return part;
}

Vector motion(std::initializer_list<double> amplitudes) {
  Vector all(static_cast<Eigen::Index>(amplitudes.size()));
  std::copy(amplitudes.begin(), amplitudes.end(), all.data());
  return all;
}

// A rotation about an axis many radii away is a translation, and is called one.
TEUCHOS_UNIT_TEST(Words, CallAFarTurnAShift) {
  const RigidPart part = bodyAt({1, 2, 0}, 1.0);
  TEST_EQUALITY(inWords(part, motion({0, 1, 0}), 2), "move upwards (0, 1)");
  TEST_EQUALITY(inWords(part, motion({-1, 0, 1e-12}), 2), "move to the left (-1, 0)");
  TEST_EQUALITY(inWords(part, motion({1, 0, 1.0 / 390}), 2), "move to the right (1, 0), turning slightly");
  TEST_EQUALITY(inWords(part, motion({0, 0, 1}), 2), "turn about (1, 2), counterclockwise");
  TEST_EQUALITY(inWords(part, motion({0, -0.5, -0.5}), 2), "turn about (0, 2), clockwise");
  const RigidPart solid = bodyAt({1, 2, 3}, 2.0);
  TEST_EQUALITY(inWords(solid, motion({0, 0, -1, 0, 0, 0}), 3), "move downwards (0, 0, -1)");
  TEST_EQUALITY(inWords(solid, motion({0, 0, 1, 1.0 / 390, 0, 0}), 3), "move upwards (0, 0, 1), turning slightly");
  TEST_EQUALITY(inWords(solid, motion({0.6, 0.8, 0, 0, 0, 0}), 3), "move (0.6, 0.8, 0)");
  TEST_EQUALITY(inWords(solid, motion({0, 0, 0, 0, 0, 1}), 3), "turn about the axis (0, 0, 1) through (1, 2, 3)");
  // The motion that the words describe equals the given one, except for the fraction that they omit.
  const Vector far = motion({1, 0, 1.0 / 21});
  const Point moved = part.displacement({2, 2, 0}, far, 2);
  TEST_COMPARE(std::abs(moved[0] - 1.0) + std::abs(moved[1]), <, 0.06);
}

TEUCHOS_UNIT_TEST(Words, OfMotionsAndVerdictsHaveNoFaultInAnyBranch) {
  TEST_INEQUALITY(faultOf("exceeds 1.0e-06 at on the path"), "");
  int read = 0;
  const auto check = [&](const std::string& text) {
    ++read;
    TEST_EQUALITY(faultOf(text), "");
  };
  for (int branch = 0; branch < 8; ++branch)
    for (const std::string words : {"move upwards (0, 1)", "move to the right (1, 0), turning slightly", "turn about (3, 4), clockwise"}) {
      NeutralMotion motion{"wheel", words, (branch & 1) != 0, (branch & 2) != 0};
      motion.least = (branch & 4) != 0;
      check(inWords(motion));
      check(undetermined({motion, motion}));
    }
  const Check balance{"balance", 2e-5, 1e-6, "body 'left', (0, 3)", "Advice one"},
      path{"work", 2e-5, 1e-6, "on the path to t = 1", "Advice two"}, kept{"residual", 1e-9, 1e-6, "at (0, 3)", "None"};
  for (const std::vector<Check>& checks :
       std::vector<std::vector<Check>>{{}, {kept}, {balance}, {path}, {balance, path}, {kept, path, path}}) {
    Verification verdict;
    verdict.checks = checks;
    check(verdict.failure());
  }
  Verification verdict;
  verdict.checks = {path};
  TEST_EQUALITY(verdict.failure(), "work 2.0e-05 exceeds 1.0e-06 (on the path to t = 1). Advice two");
  TEST_EQUALITY(read, 8 * 3 * 2 + 6);

  // A run that did not converge: no advice on the solver, but on the scene.
  TEST_EQUALITY(adviceOf(Quantity::Nodes, false, false), "");
  TEST_INEQUALITY(adviceOf(Quantity::Nodes), "");
  TEST_EQUALITY(adviceOf(Quantity::Digits, false, false), adviceOf(Quantity::Digits));
  verdict.checks.front().advice = "";
  TEST_EQUALITY(verdict.failure(), "work 2.0e-05 exceeds 1.0e-06 (on the path to t = 1)");
}

}  // namespace
}  // namespace suture
