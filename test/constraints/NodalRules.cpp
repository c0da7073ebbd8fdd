#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>
#include <map>
#include <suture/base/Point.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

// u at a node whose rule fixes it completely.
Point fixedValue(const NodeRule& rule) {
  Point u{0, 0, 0};
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j) u[j] += rule.axes[k][j] * rule.value[k];
  return u;
}

}  // namespace

TEUCHOS_UNIT_TEST(NodalRules, PrescribeDisplacementsByComponent) {
  const Mesh mesh = stack(1);
  const Constraints both = build(mesh, displacement("pull", "b0_right", "{0.25, -1}"));
  TEST_EQUALITY(both.rules.size(), std::size_t(3));
  for (const NodeRule& rule : both.rules) {
    TEST_EQUALITY(mesh.point(rule.node)[0], 4.0);
    TEST_ASSERT(rule.fixed[0] && rule.fixed[1]);
    TEST_EQUALITY(rule.value[0], 0.25);
    TEST_EQUALITY(rule.value[1], -1.0);
  }
  const Constraints one = build(mesh, displacement("pull", "b0_right", "-1", "y"));
  for (const NodeRule& rule : one.rules) {
    TEST_ASSERT(!rule.fixed[0] && rule.fixed[1]);
    TEST_EQUALITY(rule.value[1], -1.0);
  }
}

TEUCHOS_UNIT_TEST(NodalRules, HoldTheAxisOfBodiesOfRevolution) {
  Mesh mesh = stack(1);
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += 2)
    if (mesh.coordinates[i] == 0.0) mesh.coordinates[i] = 1e-16;  // as a mesher may produce it
  makeAxisymmetric(mesh);
  const Constraints alone = build(mesh, displacement("floor", "b0_bottom", "0.5", "y"));
  int axis = 0;
  for (const NodeRule& rule : alone.rules) {
    const bool onAxis = mesh.point(rule.node)[0] == 0.0, below = mesh.point(rule.node)[1] < 1e-15;
    axis += onAxis;
    TEST_EQUALITY(rule.fixed[0], onAxis);
    TEST_EQUALITY(rule.fixed[1], below);
    TEST_EQUALITY(rule.value[0], 0.0);
    TEST_EQUALITY(rule.value[1], below ? 0.5 : 0.0);
  }
  TEST_EQUALITY(axis, 3);
  // A condition that would open a hole along the axis.
  SUTURE_CHECK_SAYS(
      said(mesh, displacement("split", "b0_left", "0.1", "x") + displacement("floor", "b0_bottom", "0", "y")),
      "Boundary Conditions/split: at (0, 0) the displacement along (1, 0) should be 0.1, but 'the axis of symmetry' makes it 0 (likewise "
      "at 2 more nodes)");
  Mesh across = stack(1);
  moveAll(across, [](Point p) -> Point { return {p[0] - 0.5, p[1], 0}; });
  TEST_THROW(makeAxisymmetric(across), InputError);
}

TEUCHOS_UNIT_TEST(NodalRules, HoldTheNormalOfARoller) {
  Mesh mesh = stack(1);
  const double angle = 0.3;
  moveAll(mesh, [&](Point p) -> Point {
    return {p[0] * std::cos(angle) - p[1] * std::sin(angle), p[0] * std::sin(angle) + p[1] * std::cos(angle), 0};
  });
  const Constraints constraints = build(mesh, bilateral("roller", "b0_bottom"));
  TEST_EQUALITY(constraints.rules.size(), std::size_t(9));
  for (const NodeRule& rule : constraints.rules) {
    TEST_ASSERT(rule.fixed[0] && !rule.fixed[1]);
    TEST_EQUALITY(rule.value[0], 0.0);
    TEST_FLOATING_EQUALITY(rule.axes[0][0], std::sin(angle), 1e-12);  // outward: down, rotated
    TEST_FLOATING_EQUALITY(rule.axes[0][1], -std::cos(angle), 1e-12);
    const Matrix q = axesOf(rule, 2);
    TEST_COMPARE((q * q.transpose() - Matrix::Identity(2, 2)).norm(), <, 1e-14);
    TEST_FLOATING_EQUALITY(q.determinant(), 1.0, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(NodalRules, KeepCartesianAxesOnCartesianRollers) {
  const Mesh mesh = stack(1);
  for (const NodeRule& rule : build(mesh, bilateral("roller", "b0_left")).rules) {
    TEST_ASSERT(rule.fixed[0] && !rule.fixed[1]);
    TEST_ASSERT(axesOf(rule, 2) == Matrix::Identity(2, 2));
  }
}

TEUCHOS_UNIT_TEST(NodalRules, FixACornerWhereTwoRollersMeet) {
  const Mesh mesh = stack(1);
  const Constraints constraints = build(mesh, bilateral("a", "b0_left") + bilateral("b", "b0_bottom"));
  TEST_EQUALITY(constraints.rules.size(), std::size_t(3 + 9 - 1));
  const NodeRule& corner = *ruleAt(constraints, nodeAt(mesh, 0, 0, 0));
  TEST_ASSERT(corner.fixed[0] && corner.fixed[1]);
  TEST_EQUALITY(corner.value[0], 0.0);
}

TEUCHOS_UNIT_TEST(NodalRules, TreatASharpCornerOfOneGroupAsTwoRows) {
  Mesh mesh = stack(1);
  std::vector<Side>& wall = mesh.sideGroups["wall"];
  for (const char* name : {"b0_left", "b0_bottom"}) wall.insert(wall.end(), mesh.sideGroups[name].begin(), mesh.sideGroups[name].end());
  const Constraints constraints = build(mesh, bilateral("a", "wall"));
  const NodeRule& corner = *ruleAt(constraints, nodeAt(mesh, 0, 0, 0));
  TEST_ASSERT(corner.fixed[0] && corner.fixed[1]);
  TEST_EQUALITY(constraints.rules.size(), std::size_t(3 + 9 - 1));
}

TEUCHOS_UNIT_TEST(NodalRules, AverageTheNormalsOfACurvedWallAlsoAcrossTwoGroups) {
  // the bottom becomes an arc of radius 4 about (2, 5); half of it has another name
  Mesh mesh = stack(1, 16);
  moveAll(mesh, [](Point p) -> Point {
    const double angle = (p[0] - 2) / 4, r = 4 - p[1];
    return {2 + r * std::sin(angle), 5 - r * std::cos(angle), 0};
  });
  std::vector<Side> all = mesh.sideGroups.at("b0_bottom"), left, right;
  for (const Side& side : all) (mesh.point(mesh.nodesOf(side)[1])[0] < 2 + 1e-9 ? left : right).push_back(side);
  mesh.sideGroups["one"] = left;
  mesh.sideGroups["two"] = right;
  const Constraints whole = build(mesh, bilateral("a", "b0_bottom"));
  const Constraints parts = build(mesh, bilateral("a", "one") + bilateral("b", "two"));
  TEST_EQUALITY(whole.rules.size(), std::size_t(17));
  TEST_EQUALITY(parts.rules.size(), std::size_t(17));
  int inner = 0;
  for (std::size_t i = 0; i < whole.rules.size(); ++i) {
    TEST_ASSERT(axesOf(whole.rules[i], 2).isApprox(axesOf(parts.rules[i], 2), 1e-14));
    TEST_ASSERT(whole.rules[i].fixed == parts.rules[i].fixed);
    const Point p = mesh.point(whole.rules[i].node);
    if (std::abs(p[0] - 2) > 1.7) continue;  // the ends have only one side
    ++inner;
    // radial; for a Cartesian rule (in the middle) the fixed axis is the second
    const Point& n = whole.rules[i].fixed[0] ? whole.rules[i].axes[0] : whole.rules[i].axes[1];
    TEST_COMPARE(std::abs(n[0] * (p[1] - 5) - n[1] * (p[0] - 2)), <, 1e-12);
  }
  TEST_COMPARE(inner, >, 10);
}

TEUCHOS_UNIT_TEST(NodalRules, FixANodeByTwoObliqueRows) {
  // a roller inclined by 45 degrees to the bottom, with u_x given there: u_y follows
  Mesh mesh = stack(1);
  moveAll(mesh, [](Point p) -> Point { return {p[0] - p[1], p[1], 0}; });
  const Constraints constraints = build(mesh, bilateral("lean", "b0_right") + displacement("pull", "b0_bottom", "0.5", "x"));
  const NodeRule& corner = *ruleAt(constraints, nodeAt(mesh, 0, 4, 0));
  TEST_ASSERT(corner.fixed[0] && corner.fixed[1]);
  const Point u = fixedValue(corner);
  TEST_FLOATING_EQUALITY(u[0], 0.5, 1e-13);
  TEST_FLOATING_EQUALITY(u[0] + u[1], 0.0, 1e-13);  // outward normal (1, 1)
}

TEUCHOS_UNIT_TEST(NodalRules, AcceptEqualValuesAndRefuseUnequalOnes) {
  const Mesh mesh = stack(1);
  TEST_EQUALITY(said(mesh, displacement("a", "b0_right", "{0.1, 0}") + displacement("b", "b0_bottom", "0", "y")), "no error");
  const std::string text = said(mesh, displacement("a", "b0_right", "{0.1, 0.2}") + displacement("b", "b0_bottom", "0", "y"));
  SUTURE_CHECK_SAYS(text, "Boundary Conditions/b: at (4, 0) the displacement along (0, 1) should be 0, but 'a' makes it 0.2");
  const std::string roller = said(mesh, displacement("a", "b0_right", "{0.1, 0.2}") + bilateral("b", "b0_right"));
  SUTURE_CHECK_SAYS(roller, "Boundary Conditions/b: at (4, ");
  SUTURE_CHECK_SAYS(roller, "(likewise at 2 more nodes)");
}

TEUCHOS_UNIT_TEST(NodalRules, WantTheFormOfEachType) {
  const Mesh mesh = stack(1);
  const std::string text =
      said(mesh, entry("no group", {{"Type", "Bilateral"}}) +
                     entry("valued roller", {{"Type", "Bilateral"}, {"Group", "b0_left"}, {"Value", "1"}}) +
                     entry("scalar traction", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Value", "1"}}) +
                     entry("vector pressure", {{"Type", "Pressure"}, {"Group", "b0_top"}, {"Value", "{1, 2}"}}) +
                     entry("no value", {{"Type", "Pressure"}, {"Group", "b0_top"}}) +
                     entry("two for x", {{"Type", "Displacement"}, {"Group", "b0_left"}, {"Value", "{1, 2}"}, {"Components", "x"}}) +
                     entry("x pressure", {{"Type", "Pressure"}, {"Group", "b0_top"}, {"Value", "1"}, {"Components", "x"}}) +
                     entry("force on a curve", {{"Type", "Body Force"}, {"Group", "b0_top"}, {"Value", "{0, 1}"}}) +
                     entry("force on nobody", {{"Type", "Body Force"}, {"Body", "b1"}, {"Value", "{0, 1}"}}) +
                     entry("seeded traction", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Value", "{0, 1}"}, {"Seed", "1"}}) +
                     entry("noise on a curve", {{"Type", "Random Load"}, {"Group", "b0_top"}}) +
                     entry("valued noise", {{"Type", "Random Load"}, {"Amplitude", "1"}, {"Value", "1"}}) +
                     entry("traction of a body", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Body", "b0"}, {"Value", "{0, 1}"}}) +
                     entry("nowhere", {{"Type", "Pressure"}, {"Group", "b0_topp"}, {"Value", "1"}}));
  for (const std::string part :
       {"no group/Group: is missing: a Bilateral needs a curve group. Curve groups: b0_bottom, b0_left, b0_right, b0_top",
        "valued roller/Value: a Bilateral condition has no value", "scalar traction/Value: 1 values; this Traction needs 2 values",
        "vector pressure/Value: 2 values; this Pressure needs 1 value",
        "no value/Value: is missing; this Pressure needs 1 value, or Expression",
        "two for x/Value: 2 values; this Displacement needs 1 value",
        "x pressure/Components: only a Displacement or a Mean Displacement takes this parameter",
        "force on a curve/Group: a Body Force acts on a body", "force on nobody/Body: no such body 'b1'",
        "traction of a body/Body: a Traction acts on a curve group, not on a body; name the group in Group",
        "seeded traction/Seed: only a Random Load takes this parameter; found in a Traction",
        "noise on a curve/Group: a Random Load acts on a body", "noise on a curve/Amplitude: is missing",
        "valued noise/Value: a Random Load has no value",
        "nowhere/Group: in the mesh boxes: no such curve group 'b0_topp'. Did you mean 'b0_top'?"})
    SUTURE_CHECK_SAYS(text, "Boundary Conditions/" + part);
}

TEUCHOS_UNIT_TEST(NodalRules, TakeLoadsOfTheRightForm) {
  const Mesh mesh = stack(1);
  TEST_EQUALITY(said(mesh, bilateral("hold", "b0_bottom") + entry("t", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Value", "{1, 2}"}}) +
                               entry("p", {{"Type", "Pressure"}, {"Group", "b0_top"}, {"Value", "1"}}) +
                               entry("f", {{"Type", "Body Force"}, {"Body", "b0"}, {"Value", "{0, -9.81}"}}) +
                               entry("g", {{"Type", "Body Force"}, {"Value", "{0, -9.81}"}}) +
                               entry("h", {{"Type", "Random Load"}, {"Amplitude", "2"}, {"Seed", "3"}, {"Body", "b0"}})),
                "no error");
}

TEUCHOS_UNIT_TEST(NodalRules, TakeDisplacementsThatDependOnThePlace) {
  const Mesh mesh = stack(1);
  const Constraints both =
      build(mesh, entry("pull", {{"Type", "Displacement"}, {"Group", "b0_bottom"}, {"Expression x", "A*x^2"}, {"Expression y", "y - x"}}));
  TEST_EQUALITY(both.rules.size(), std::size_t(9));
  for (const NodeRule& rule : both.rules) {
    const Point p = mesh.point(rule.node);
    TEST_ASSERT(rule.fixed[0] && rule.fixed[1]);
    TEST_FLOATING_EQUALITY(rule.value[0] + 1, 2.5 * p[0] * p[0] + 1, 1e-14);
    TEST_FLOATING_EQUALITY(rule.value[1] + 1, p[1] - p[0] + 1, 1e-14);
  }
  const Constraints one =
      build(mesh, entry("pull", {{"Type", "Displacement"}, {"Group", "b0_right"}, {"Components", "y"}, {"Expression y", "3*y"}}));
  for (const NodeRule& rule : one.rules) {
    TEST_ASSERT(!rule.fixed[0] && rule.fixed[1]);
    TEST_EQUALITY(rule.value[1], 3 * mesh.point(rule.node)[1]);
  }
}

TEUCHOS_UNIT_TEST(NodalRules, WantExpressionsThatFitTheType) {
  const Mesh mesh = stack(1);
  const std::string text = said(
      mesh, entry("both", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Value", "{1, 2}"}, {"Expression x", "1"}}) +
                entry("half", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Expression x", "1"}}) +
                entry("vector pressure", {{"Type", "Pressure"}, {"Group", "b0_top"}, {"Expression x", "1"}}) +
                entry("scalar force", {{"Type", "Body Force"}, {"Expression", "1"}}) +
                entry("free",
                      {{"Type", "Displacement"}, {"Group", "b0_left"}, {"Components", "x"}, {"Expression x", "0"}, {"Expression y", "0"}}) +
                entry("roller", {{"Type", "Bilateral"}, {"Group", "b0_left"}, {"Expression x", "0"}}) +
                entry("noise", {{"Type", "Random Load"}, {"Amplitude", "1"}, {"Expression", "0"}}) +
                entry("typo", {{"Type", "Pressure"}, {"Group", "b0_top"}, {"Expression", "B*x"}}));
  for (const std::string part :
       {"both/Value: 'Value' and 'Expression x' are both given; expected only one of them",
        "half/Expression y: is missing: this Traction needs Expression x and Expression y; write 0 for a zero component",
        "vector pressure/Expression x: not a parameter of this Pressure: expected Expression", "vector pressure/Expression: is missing",
        "scalar force/Expression: not a parameter of this Body Force: expected Expression x and Expression y",
        "free/Expression y: not a parameter of this Displacement: expected Expression x",
        "roller/Expression x: a Bilateral condition has no value", "noise/Expression: a Random Load has no value",
        "typo/Expression: 'B*x': unknown: 'B'. Variables: x, y. Constants: A, pi. Functions: abs, "})
    SUTURE_CHECK_SAYS(text, "Boundary Conditions/" + part);
}

TEUCHOS_UNIT_TEST(NodalRules, TellWhereADisplacementIsNotFinite) {
  const Mesh mesh = stack(1);
  const std::string text = said(
      mesh, entry("pull", {{"Type", "Displacement"}, {"Group", "b0_bottom"}, {"Expression x", "1/(x - 2)"}, {"Expression y", "0"}}) +
                entry("push", {{"Type", "Displacement"}, {"Group", "b0_top"}, {"Expression x", "0"}, {"Expression y", "sqrt(x - 10)"}}));
  SUTURE_CHECK_SAYS(text, "Boundary Conditions/pull/Expression x: '1/(x - 2)' is infinite at (x, y) = (2, 0)");
  SUTURE_CHECK_SAYS(text, "Boundary Conditions/push/Expression y: 'sqrt(x - 10)' is not a number (nan) at (x, y) = (");
}

/// The force that holds a node is distributed completely to the conditions behind its rule, each along its own direction.
TEUCHOS_UNIT_TEST(NodalRules, ShareTheForceOfANodeAmongTheirConditions) {
  Mesh mesh = stack(1);
  moveAll(mesh, [](Point p) -> Point { return {p[0] + 0.5 * p[1], p[1], 0}; });  // inclined sides
  const Constraints all = build(mesh, bilateral("wall", "b0_left") + displacement("floor", "b0_bottom", "0", "y") +
                                          displacement("same floor", "b0_bottom", "0", "y") + displacement("push", "b0_right", "{0, 0}"));
  TEST_EQUALITY(all.conditions.size(), 4);
  TEST_EQUALITY(all.conditions[2], "same floor");
  const Point force{3, -5, 0}, wall{-1 / std::sqrt(1.25), 0.5 / std::sqrt(1.25), 0};
  const auto shares = [&](double x, double y) {
    std::map<int, Point> found;
    for (const Support& support : all.supports)
      if (support.node == nodeAt(mesh, 0, x, y))
        found[support.condition] = plus(found[support.condition], scaled(dot(support.along, force), support.direction));
    return found;
  };
  const std::map<int, Point> corner = shares(0, 0), middle = shares(2, 0), right = shares(4.5, 1), beside = shares(4, 0);
  TEST_EQUALITY(corner.size(), 3);
  TEST_COMPARE(norm(minus(plus(corner.at(0), plus(corner.at(1), corner.at(2))), force)), <, 1e-14);
  TEST_COMPARE(norm(cross(corner.at(0), wall)), <, 1e-14);  // along its normal
  TEST_COMPARE(norm(minus(corner.at(1), corner.at(2))), <, 1e-15);
  TEST_EQUALITY(corner.at(1)[0], 0.0);
  TEST_EQUALITY(middle.size(), 2);
  TEST_EQUALITY(middle.at(1)[1], -2.5);
  TEST_EQUALITY(middle.at(2)[1], -2.5);
  TEST_COMPARE(norm(minus(right.at(3), force)), <, 1e-14);
  // Three conditions hold the corner upwards.
  TEST_EQUALITY(beside.size(), 3);
  TEST_FLOATING_EQUALITY(beside.at(1)[1], -5.0 / 3, 1e-14);
  TEST_FLOATING_EQUALITY(beside.at(3)[1], -5.0 / 3, 1e-14);
  TEST_FLOATING_EQUALITY(beside.at(3)[0], 3.0, 1e-14);
}

// A direction off the axes: the same as a roller on a side with this normal, with a value; and about an axis perpendicular to the plane.
TEUCHOS_UNIT_TEST(NodalRules, PrescribeTheDisplacementAlongADirection) {
  const Mesh mesh = stack(1);
  const auto held = [&](std::vector<std::pair<std::string, std::string>> more) {
    more.insert(more.begin(), {{"Type", "Displacement"}, {"Group", "b0_right"}});
    return entry("pull", more);
  };
  for (const NodeRule& rule : build(mesh, held({{"Direction", "{3, 4}"}, {"Value", "{0.5}"}})).rules) {
    TEST_ASSERT(rule.fixed[0] && !rule.fixed[1]);
    TEST_FLOATING_EQUALITY(rule.axes[0][0], 0.6, 1e-14);
    TEST_FLOATING_EQUALITY(rule.axes[0][1], 0.8, 1e-14);
    TEST_EQUALITY(rule.value[0], 0.5);
  }
  for (const NodeRule& rule : build(mesh, held({{"Direction", "{0, -2}"}, {"Expression", "y"}})).rules) {
    TEST_ASSERT(!rule.fixed[0] && rule.fixed[1]);  // Cartesian
    TEST_EQUALITY(rule.value[1] + mesh.point(rule.node)[1], 0.0);
  }
  // A rotation by a small angle about (1, 2) has the displacement (-(y - 2), x - 1) times the angle.
  const std::string turn =
      held({{"Along", "Circumference"}, {"Axis Point", "{1, 2}"}, {"Expression", "0.01*sqrt((x - 1)^2 + (y - 2)^2)"}}) +
      entry("stay", {{"Type", "Displacement"}, {"Group", "b0_right"}, {"Along", "Radius"}, {"Axis Point", "{1, 2}"}, {"Value", "{0}"}});
  const Constraints turned = build(mesh, turn);
  TEST_EQUALITY(turned.rules.size(), 3u);
  for (const NodeRule& rule : turned.rules) {
    const Point u = fixedValue(rule), p = mesh.point(rule.node);
    TEST_ASSERT(rule.fixed[0] && rule.fixed[1]);
    TEST_COMPARE(std::abs(u[0] + 0.01 * (p[1] - 2)), <, 1e-15);
    TEST_COMPARE(std::abs(u[1] - 0.01 * (p[0] - 1)), <, 1e-15);
  }
  SUTURE_CHECK_SAYS(said(mesh, held({{"Along", "Radius"}, {"Axis Point", "{4, 0.5}"}, {"Value", "{0}"}})),
                    "Boundary Conditions/pull/Along: the node at (4, 0.5) is on the axis");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Direction", "{3, 4}"}, {"Value", "{0.5, 1}"}})),
                    "pull/Value: 2 values; this Displacement needs 1 value, or Expression");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Direction", "{0, 0}"}, {"Value", "{0.5}"}})), "pull/Direction: the vector is zero");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Direction", "{1, 0, 0}"}, {"Value", "{0.5}"}})), "pull/Direction: 3 coordinates; expected 2");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Direction", "{1, 0}"}, {"Components", "x"}, {"Value", "{0.5}"}})),
                    "pull/Components: found together with a direction");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Along", "Direction"}, {"Value", "{0.5}"}})), "pull/Direction: is missing");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Along", "Radius"}, {"Direction", "{1, 0}"}, {"Value", "{0.5}"}})),
                    "pull/Direction: the axis of a 2D scene is perpendicular to the plane");
  SUTURE_CHECK_SAYS(said(mesh, held({{"Axis Point", "{1, 0}"}, {"Value", "{0.5, 1}"}})), "pull/Axis Point: only a Displacement with Along");
}
