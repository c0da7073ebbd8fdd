// A rigid obstacle against the lower side of a box: normals and gaps from its geometry.
#include <Teuchos_UnitTestHarness.hpp>

#include <set>

#include "ConstraintsTesting.hpp"

namespace {

using namespace constraintstesting;

Mesh box(Cell cell = Cell::Triangle3) {
  Box body;
  body.name = "b";
  body.x0 = -1, body.x1 = 1, body.y1 = 1;
  body.nx = 8, body.ny = 4, body.cell = cell;
  Mesh mesh = boxes({body});
  assignBodies(mesh, {"b"});
  return mesh;
}

const std::string held = displacement("above", "b_top", "{0.0, 0.0}");

std::string against(const std::string& type, const std::string& sublist, const std::string& more = "",
                    const std::string& side = "b_bottom") {
  return "<ParameterList name=\"ground\"><Parameter name=\"Side A\" value=\"" + side + "\"/><Parameter name=\"Obstacle\" value=\"" + type +
         "\"/>" + more + sublist + "</ParameterList>";
}

TEUCHOS_UNIT_TEST(ObstaclePairs, HasOneEndAPair) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral9}) {
    const Mesh mesh = box(cell);
    const Constraints constraints = build(mesh, held, against("Line", entry("Line", {{"Point", "{0.0, -0.5}"}, {"Normal", "{0.0, 3.0}"}})));
    TEST_EQUALITY(constraints.pairs.size(), cell == Cell::Triangle3 ? 9u : 17u);
    double length = 0;
    for (const ContactPair& pair : constraints.pairs) {
      TEST_EQUALITY(pair.ends.size(), 1u);
      TEST_EQUALITY(pair.ends[0].weight, 1.0);
      TEST_EQUALITY(pair.normal[1], -1.0);
      TEST_FLOATING_EQUALITY(pair.gap, 0.5, 1e-14);
      length += pair.length;
    }
    TEST_FLOATING_EQUALITY(length, 2.0, 1e-13);
    TEST_EQUALITY(constraints.pieces.size(), 1u);
    TEST_ASSERT(constraints.pieces[0].bodies == std::vector<int>{0});
  }
}

TEUCHOS_UNIT_TEST(ObstaclePairs, MeasuresAlongTheNormalOfAnInclinedLine) {
  const Mesh mesh = box();
  for (const ContactPair& pair :
       build(mesh, held, against("Line", entry("Line", {{"Point", "{0.0, -1.0}"}, {"Normal", "{-0.6, 0.8}"}}))).pairs) {
    TEST_FLOATING_EQUALITY(pair.gap, -0.6 * pair.position[0] + 0.8, 1e-13);
    TEST_FLOATING_EQUALITY(pair.normal[0], 0.6, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ObstaclePairs, MeasuresTheDistanceFromACircle) {
  const Mesh mesh = box();
  for (const ContactPair& pair :
       build(mesh, held, against("Circle", entry("Circle", {{"Centre", "{0.0, -3.0}"}, {"Radius", "2.5"}}))).pairs) {
    const double distance = std::hypot(pair.position[0], 3.0);
    TEST_FLOATING_EQUALITY(pair.gap, distance - 2.5, 1e-13);
    TEST_FLOATING_EQUALITY(pair.normal[1], -3.0 / distance, 1e-13);
  }
  for (const ContactPair& pair :
       build(mesh, held, against("Circle", entry("Circle", {{"Centre", "{0.0, 4.0}"}, {"Radius", "5"}, {"Hollow", "true"}}))).pairs) {
    const double distance = std::hypot(pair.position[0], 4.0);
    TEST_FLOATING_EQUALITY(pair.gap, 5 - distance, 1e-13);
    TEST_FLOATING_EQUALITY(pair.normal[1], -4.0 / distance, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ObstaclePairs, LinearisesTheConditionOnAGraph) {
  const Mesh mesh = box();
  const std::vector<std::pair<std::string, std::string>> graph{{"Expression", "-0.05 * (x - 0.5)^2 - 0.1 * sin(x)"}};
  const auto height = [](double x) { return -0.05 * (x - 0.5) * (x - 0.5) - 0.1 * std::sin(x); };
  auto vertical = graph;
  vertical.push_back({"Direction", "Vertical"});
  for (const ContactPair& pair : build(mesh, held, against("Height", entry("Height", graph))).pairs) {
    const double x = pair.position[0], slope = -0.1 * (x - 0.5) - 0.1 * std::cos(x), length = std::hypot(1.0, slope);
    TEST_FLOATING_EQUALITY(pair.gap, -height(x) / length, 1e-10);
    TEST_FLOATING_EQUALITY(pair.normal[0] + 1, slope / length + 1, 1e-10);
    TEST_FLOATING_EQUALITY(pair.normal[1], -1 / length, 1e-10);
  }
  for (const ContactPair& pair : build(mesh, held, against("Height", entry("Height", vertical))).pairs) {
    TEST_FLOATING_EQUALITY(pair.gap + 1, 1 - height(pair.position[0]), 1e-14);
    TEST_EQUALITY(pair.normal[1], -1.0);
  }
  auto ceiling = vertical;
  ceiling.push_back({"Body Below", "true"});
  ceiling[0].second = "1.5";
  for (const ContactPair& pair :
       build(mesh, displacement("below", "b_bottom", "{0.0, 0.0}"), against("Height", entry("Height", ceiling), "", "b_top")).pairs) {
    TEST_FLOATING_EQUALITY(pair.gap, 0.5, 1e-14);
    TEST_EQUALITY(pair.normal[1], 1.0);
  }
}

// A flat side on a small bump: beyond it nodes see it obliquely, and cannot touch it.
TEUCHOS_UNIT_TEST(ObstaclePairs, LeavesOutNodesThatSeeTheObstacleAside) {
  const Mesh mesh = box();
  for (const double x : {0.0, 0.25, -1.0}) {
    const std::string centre = "{" + std::to_string(x) + ", -0.21}";
    const Constraints bump = build(mesh, held, against("Circle", entry("Circle", {{"Centre", centre}, {"Radius", "0.2"}})));
    std::set<double> expected, found;  // tan 60 degrees times the height of the side over the centre
    for (int i = 0; i < 9; ++i)
      if (const double at = -1 + 0.25 * i; std::abs(at - x) < std::sqrt(3.0) * 0.21) expected.insert(at);
    for (const ContactPair& pair : bump.pairs) {
      found.insert(pair.position[0]);
      TEST_FLOATING_EQUALITY(pair.gap, std::hypot(pair.position[0] - x, 0.21) - 0.2, 1e-12);
    }
    TEST_ASSERT(found == expected);
    TEST_EQUALITY(bump.pieces.size(), 1u);
    TEST_EQUALITY(bump.notes.size(), 1u);
    SUTURE_CHECK_SAYS(bump.notes[0], std::to_string(9 - expected.size()) + " of the 9 nodes of 'b_bottom' see the obstacle more than 60");
  }
  // Beyond x = 0.6 the side lies inside a wall: the scene is invalid.
  SUTURE_CHECK_SAYS(said(mesh, held, against("Height", entry("Height", {{"Expression", "x > 0.6 ? 8 * (x - 0.6) : 0"}}))),
                    "'b_bottom' does not face the obstacle");
}

TEUCHOS_UNIT_TEST(ObstaclePairs, TakesTheGapOfAnExpression) {
  const Mesh mesh = box();
  for (const ContactPair& pair : build(mesh, held,
                                       against("Line", entry("Line", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, 1.0}"}}),
                                               "<Parameter name=\"Initial Gap\" value=\"x^2\"/>"))
                                     .pairs)
    TEST_FLOATING_EQUALITY(pair.gap + 1, pair.position[0] * pair.position[0] + 1, 1e-14);
}

TEUCHOS_UNIT_TEST(ObstaclePairs, SaysWhatIsWrong) {
  const Mesh mesh = box();
  const std::string ground = entry("Line", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, 1.0}"}});
  SUTURE_CHECK_SAYS(said(mesh, held, against("Line", ground, "<Parameter name=\"Side B\" value=\"b_left\"/>")),
                    "Contact/ground/Side B: found together with an Obstacle; expected only one of them");
  SUTURE_CHECK_SAYS(said(mesh, held, entry("ground", {{"Side A", "b_bottom"}})), "Contact/ground/Side B: is missing");
  SUTURE_CHECK_SAYS(said(mesh, held, against("Line", entry("Line", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, 0.0}"}}))),
                    "Contact/ground/Line/Normal: has no length");
  SUTURE_CHECK_SAYS(said(mesh, held, against("Line", entry("Line", {{"Point", "{0.0}"}, {"Normal", "{0.0, 1.0}"}}))),
                    "Contact/ground/Line/Point: found 1 numbers; expected two");
  SUTURE_CHECK_SAYS(said(mesh, held, against("Line", entry("Line", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, -1.0}"}}))),
                    "'b_bottom' does not face the obstacle");
  SUTURE_CHECK_SAYS(said(mesh, held, against("Height", entry("Height", {{"Expression", "sqt(x)"}}))), "Contact/ground/Height/Expression");
  SUTURE_CHECK_SAYS(said(mesh, held, against("Height", entry("Height", {{"Expression", "log(x)"}}))), "Contact/ground/Height/Expression");
}

}  // namespace
