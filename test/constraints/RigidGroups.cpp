#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/BuildRigidGroups.hpp>

#include <algorithm>
#include <cmath>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

std::string rigid(const std::string& group, const std::vector<std::pair<std::string, std::string>>& more = {}) {
  std::vector<std::pair<std::string, std::string>> all{{"Group", group}, {"Type", "Rigid Group"}, {"Point", "{1.0, 3.0}"}};
  all.insert(all.end(), more.begin(), more.end());
  return entry("platen", all);
}

/// Displacement of the group's nodes for given values of the masters.
std::vector<Point> moved(const Constraints& constraints, const std::vector<double>& masters) {
  const RigidGroup& group = constraints.rigidGroups.front();
  std::vector<Point> all;
  for (std::size_t i = 0; i < group.nodes.size(); ++i) {
    Point u = ruleAt(constraints, group.nodes[i])->value;
    for (int k = 0; k < 2; ++k)
      for (int m = 0; m < group.masters(); ++m) u[k] += group.row(i, k, 2)[m] * masters[m];
    all.push_back(u);
  }
  return all;
}

/// Largest difference from the rigid motion of displacement (ux, uy) and rotation w about (1, 3).
double apart(const Mesh& mesh, const RigidGroup& group, const std::vector<Point>& found, double ux, double uy, double w) {
  double most = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Point x = mesh.point(group.nodes[i]);
    most = std::max({most, std::abs(found[i][0] - (ux - w * (x[1] - 3.0))), std::abs(found[i][1] - (uy + w * (x[0] - 1.0)))});
  }
  return most;
}

}  // namespace

TEUCHOS_UNIT_TEST(RigidGroups, FollowAnyRigidMotion) {
  const Mesh mesh = stack(1);
  const Constraints free = build(mesh, bilateral("floor", "b0_bottom") + rigid("b0_top"));
  TEST_EQUALITY(free.rigidGroups.size(), std::size_t(1));
  const RigidGroup& group = free.rigidGroups.front();
  TEST_EQUALITY(group.masters(), 3);
  std::vector<double> masters;  // in the motion (0.3, -0.2), 0.1
  for (int m = 0; m < 3; ++m) {
    const Point x = mesh.point(group.masterNodes[m]);
    masters.push_back(group.masterComponents[m] == 0 ? 0.3 - 0.1 * (x[1] - 3.0) : -0.2 + 0.1 * (x[0] - 1.0));
  }
  TEST_COMPARE(apart(mesh, group, moved(free, masters), 0.3, -0.2, 0.1), <, 1e-14);
}

TEUCHOS_UNIT_TEST(RigidGroups, MoveAsPrescribed) {
  const Mesh mesh = stack(1);
  const Constraints whole = build(mesh, rigid("b0_top", {{"Motion x", "0.3"}, {"Motion y", "-0.2"}, {"Rotation z", "0.1"}}));
  TEST_EQUALITY(whole.rigidGroups.front().masters(), 0);
  TEST_COMPARE(apart(mesh, whole.rigidGroups.front(), moved(whole, {}), 0.3, -0.2, 0.1), <, 1e-14);

  // Free along y only: one master, whose value is the displacement of its node.
  const Constraints guided = build(mesh, rigid("b0_top", {{"Motion x", "0.3"}, {"Rotation z", "0.1"}}));
  const RigidGroup& group = guided.rigidGroups.front();
  TEST_EQUALITY(group.masters(), 1);
  TEST_EQUALITY(group.masterComponents.front(), 1);
  const double own = -0.2 + 0.1 * (mesh.point(group.masterNodes.front())[0] - 1.0);
  TEST_COMPARE(apart(mesh, group, moved(guided, {own}), 0.3, -0.2, 0.1), <, 1e-14);
}

// Wherever the body is, the masters are among the same two nodes, and the group follows any rigid motion.
TEUCHOS_UNIT_TEST(RigidGroups, KeepThePositionNodesOfTurnedBodies) {
  const Mesh drawn = stack(1);
  std::vector<int> first;
  for (const std::vector<int>& prescribed : {std::vector<int>{}, {0}, {1}, {0, 1}, {0, 5}})
    for (const double angle : {0.0, 0.3, 0.5 * std::acos(-1.0), 1.9, 77.0}) {
      Mesh mesh = drawn;
      for (int node = 0; node < mesh.nodes(); ++node) {
        double* x = mesh.coordinates.data() + 2 * node;
        const double c = std::cos(angle), s = std::sin(angle), x0 = x[0], x1 = x[1];
        x[0] = 5.0 + c * x0 - s * x1, x[1] = s * x0 + c * x1;
      }
      Condition condition;
      condition.name = condition.path = "platen";
      condition.type = Condition::Type::RigidGroup;
      condition.groups = {"b0_top"};
      condition.point = Point{1, 3, 0};
      condition.movesFar = true;
      const double motion[6] = {0.3, -0.2, 0, 0, 0, 0.1};
      for (const int k : prescribed) condition.motions[static_cast<std::size_t>(k)] = motion[k];
      Constraints constraints;
      Problems problems;
      buildRigidGroups(mesh, {condition}, constraints, problems);
      const RigidGroup& group = constraints.rigidGroups.front();
      if (first.empty()) first = group.positionNodes;
      TEST_EQUALITY(group.positionNodes.size(), std::size_t(2));
      TEST_ASSERT(group.positionNodes == first);
      TEST_EQUALITY(group.masters(), 3 - static_cast<int>(prescribed.size()));
      std::vector<double> masters;
      for (int m = 0; m < group.masters(); ++m) {
        TEST_ASSERT(std::find(first.begin(), first.end(), group.masterNodes[m]) != first.end());
        const Point x = mesh.point(group.masterNodes[m]);
        masters.push_back(group.masterComponents[m] == 0 ? 0.3 - 0.1 * (x[1] - 3.0) : -0.2 + 0.1 * (x[0] - 1.0));
      }
      TEST_COMPARE(apart(mesh, group, moved(constraints, masters), 0.3, -0.2, 0.1), <, 1e-13);
    }
}

TEUCHOS_UNIT_TEST(RigidGroups, TakeOverOtherSupportsOfTheirNodes) {
  const Mesh mesh = stack(1);
  // A roller at one node of the top leaves a rotation and a displacement along it.
  const Constraints both = build(mesh, displacement("wall", "b0_left", "0.05", "x") + rigid("b0_top"));
  const RigidGroup& group = both.rigidGroups.front();
  TEST_EQUALITY(group.masters(), 2);
  std::vector<double> masters;
  for (int m = 0; m < 2; ++m) {
    const Point x = mesh.point(group.masterNodes[m]);
    masters.push_back(group.masterComponents[m] == 0 ? 0.05 - 0.1 * (x[1] - 1.0) : -0.2 + 0.1 * (x[0] - 1.0));
  }
  TEST_COMPARE(apart(mesh, group, moved(both, masters), 0.05 - 0.1 * 2.0, -0.2, 0.1), <, 1e-14);
  int walls = 0;
  for (const Support& support : both.supports) walls += support.condition == 0;
  TEST_EQUALITY(walls, 2);  // the third node of the wall belongs to the group
  SUTURE_CHECK_SAYS(
      said(mesh, displacement("wall", "b0_left", "0.05", "x") + displacement("end", "b0_right", "0.06", "x") + rigid("b0_top")),
      "Boundary Conditions/platen: other conditions on its nodes would deform it, for instance at (");
}

TEUCHOS_UNIT_TEST(RigidGroups, BelongToOneBody) {
  SUTURE_CHECK_SAYS(said(stack(2), rigid("{b0_left, b1_left}") + bilateral("floor", "b0_bottom")),
                    "Boundary Conditions/platen/Group: has nodes of the bodies 'b0' and 'b1'");
}
