// The constraints of the paper's model problem, against its geometry. Needs SUTURE_GMSH.
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

struct Tunnel {
  Mesh mesh;
  Constraints constraints;
};

const Tunnel& tunnel() {
  static const Tunnel one = [] {
    Tunnel t;
    t.mesh = readGmsh({SUTURE_SOURCE_DIR "/input/tunnel/tunnel.geo", {}, 1.0});
    assignBodies(t.mesh, {"left", "right"});
    t.constraints = build(
        t.mesh,
        entry("overburden", {{"Group", "top"}, {"Type", "Pressure"}, {"Value", "0.5e7"}}) + bilateral("rollers left", "left_side") +
            bilateral("rollers below", "bottom") + displacement("push", "right_side", "{-2.5e-2, 0.0}"),
        contact("fault above", "fault_upper_left", "fault_upper_right") + contact("fault below", "fault_lower_left", "fault_lower_right"));
    return t;
  }();
  return one;
}

const double lean = 25 * 3.14159265358979323846 / 180;

}  // namespace

TEUCHOS_UNIT_TEST(Tunnel, Has89PairsInTwoPieces) {
  const Constraints& constraints = tunnel().constraints;
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(89));
  TEST_EQUALITY(constraints.pieces.size(), std::size_t(2));
  TEST_EQUALITY(constraints.pieces[0].pairs.size(), std::size_t(45));
  TEST_EQUALITY(constraints.pieces[1].pairs.size(), std::size_t(44));
  TEST_EQUALITY(constraints.pieces[0].name, "fault above");
  TEST_EQUALITY(constraints.pieces[1].name, "fault below");
}

TEUCHOS_UNIT_TEST(Tunnel, HasClosedPairsAcrossTheLeaningFault) {
  // along the fault: (-sin 25, cos 25) upwards; the normal from left to right: (cos 25, sin 25)
  for (const ContactPair& pair : tunnel().constraints.pairs) {
    TEST_FLOATING_EQUALITY(pair.normal[0], std::cos(lean), 1e-9);
    TEST_FLOATING_EQUALITY(pair.normal[1], std::sin(lean), 1e-9);
    TEST_COMPARE(std::abs(pair.gap), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(Tunnel, HasTributaryLengthsThatFillTheFault) {
  // the fault has H / cos 25 = 80 / cos 25 between top and bottom, less the hole
  double length = 0;
  for (const ContactPair& pair : tunnel().constraints.pairs) length += pair.length;
  TEST_FLOATING_EQUALITY(length, 80 / std::cos(lean) - 12, 1e-9);
}

TEUCHOS_UNIT_TEST(Tunnel, FixesTheCornersWhereTwoConditionsMeet) {
  const Tunnel& t = tunnel();
  const NodeRule& right = *ruleAt(t.constraints, nodeAt(t.mesh, 1, 120, 0));
  TEST_ASSERT(right.fixed[0] && right.fixed[1]);
  TEST_EQUALITY(right.value[0], -2.5e-2);
  TEST_EQUALITY(right.value[1], 0.0);
  const NodeRule& left = *ruleAt(t.constraints, nodeAt(t.mesh, 0, 0, 0));
  TEST_ASSERT(left.fixed[0] && left.fixed[1]);
  TEST_EQUALITY(left.value[0], 0.0);
}

TEUCHOS_UNIT_TEST(Tunnel, KeepsTheRollerAtTheFootOfTheFault) {
  const Tunnel& t = tunnel();
  int feet = 0;
  for (const ContactPair& pair : t.constraints.pairs)
    for (const int node : {pair.ends[0].node, pair.ends[1].node}) {
      const NodeRule& rule = *ruleAt(t.constraints, node);
      if (std::abs(t.mesh.point(node)[1]) < 1e-9) {
        ++feet;
        TEST_ASSERT(!rule.fixed[0] && rule.fixed[1]);
        TEST_ASSERT(axesOf(rule, 2) == Matrix::Identity(2, 2));
      } else {
        TEST_ASSERT(rule.axes[0] == pair.normal);
        TEST_ASSERT(!rule.fixed[0] && !rule.fixed[1]);
      }
    }
  TEST_EQUALITY(feet, 2);
}

TEUCHOS_UNIT_TEST(Tunnel, RefusesTheWrongPartner) {
  const auto told = [](const std::string& line) { return said(tunnel().mesh, bilateral("a", "bottom"), line); };
  SUTURE_CHECK_SAYS(told(contact("c", "fault_upper_left", "fault_lower_right")), "overlap nowhere");
  const std::string text = told(matching("c", "fault_upper_left", "fault_lower_right"));
  SUTURE_CHECK_SAYS(text, "'fault_upper_left' has 45 nodes, 'fault_lower_right' has 44 nodes");
}

namespace {

int pairsOf(const std::string& scene, const std::vector<std::string>& bodies, const std::string& a, const std::string& b) {
  Mesh mesh = readGmsh({SUTURE_SOURCE_DIR "/input/" + scene, {}, 1.0});
  assignBodies(mesh, bodies);
  return static_cast<int>(build(mesh, "", contact("c", a, b)).pairs.size());
}

}  // namespace

TEUCHOS_UNIT_TEST(Scenes, MatchWithGapsAndOnArcs) {
  TEST_EQUALITY(pairsOf("hertz/hertz.geo", {"cylinder", "block"}, "cylinder_contact", "block_contact"), 21);  // 1.25 x 16 elements
  TEST_EQUALITY(pairsOf("rings/rings.geo", {"outer", "inner"}, "outer_contact", "inner_contact"), 49);
}
