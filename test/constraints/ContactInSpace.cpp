// Pieces, rims, frames and rows of 3D contacts.
#include <Teuchos_UnitTestHarness.hpp>
#include <pairs/SpaceScenes.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/motion/RigidMotion.hpp>

#include <set>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

std::vector<Condition> clamped() { return {Condition::displacement("lower_bottom", {0, 0, 0}, {0, 1, 2})}; }

/// Sides of a group whose vertices are all on one side of a plane.
std::vector<Side> some(const Mesh& mesh, const std::string& group, const std::function<bool(Point)>& wanted) {
  std::vector<Side> sides;
  for (const Side& side : mesh.sideGroups.at(group)) {
    bool all = true;
    for (const int node : mesh.nodesOf(side)) all = all && wanted(mesh.point(node));
    if (all) sides.push_back(side);
  }
  return sides;
}

}  // namespace

TEUCHOS_UNIT_TEST(ContactInSpace, HasAPieceForEachConnectedPart) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27, Cell::Tetrahedron10}) {
    Mesh mesh = facing(cell, 4, 2, cell, 4, 2, 0.0);
    const std::vector<Side> left = some(mesh, "lower_top", [](Point p) { return p[0] < 0.5 + 1e-9; }),
                            right = some(mesh, "lower_top", [](Point p) { return p[0] > 1.5 - 1e-9; });
    mesh.sideGroups["feet"] = left;
    mesh.sideGroups["feet"].insert(mesh.sideGroups["feet"].end(), right.begin(), right.end());
    const std::vector<Side> above = some(mesh, "upper_bottom", [](Point p) { return p[0] < 0.5 + 1e-9 || p[0] > 1.5 - 1e-9; });
    std::vector<Side> feet;
    for (const Side& side : above) {
      double low = 2, high = 0;
      for (const int node : mesh.nodesOf(side)) low = std::min(low, mesh.point(node)[0]), high = std::max(high, mesh.point(node)[0]);
      if (high - low < 0.6) feet.push_back(side);
    }
    mesh.sideGroups["feet above"] = feet;
    const Constraints constraints = buildConstraints(mesh, clamped(), {Contact::between("feet", "feet above")});
    TEST_EQUALITY(constraints.pieces.size(), std::size_t(2));
    TEST_EQUALITY(constraints.pieces[0].pairs.size(), constraints.pieces[1].pairs.size());
    double area = 0;
    for (const ContactPair& pair : constraints.pairs) area += pair.length;
    TEST_FLOATING_EQUALITY(area, 2 * 0.5 * 1.5, 1e-12);
    TEST_EQUALITY(constraints.pieces[1].name, "feet on feet above 2");
  }
}

// The contact ends in the middle of both faces, which continue there. Elsewhere it ends with the faces.
TEUCHOS_UNIT_TEST(ContactInSpace, IsOpenAtTheRimWhereBothBoundariesGoOn) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27}) {
    Mesh mesh = facing(cell, 4, 2, cell, 4, 2, 0.0);
    const auto half = [](Point p) { return p[0] < 1 + 1e-9; };
    mesh.sideGroups["half"] = some(mesh, "lower_top", half);
    mesh.sideGroups["half above"] = some(mesh, "upper_bottom", half);
    const Constraints constraints = buildConstraints(mesh, clamped(), {Contact::between("half", "half above")});
    TEST_EQUALITY(constraints.pieces.size(), std::size_t(1));
    std::set<int> expected;
    for (const ContactPair& pair : constraints.pairs)
      if (std::abs(pair.position[0] - 1) < 1e-9) expected.insert(pair.id);
    TEST_EQUALITY(expected.size(), std::size_t(cell == Cell::Hexahedron27 ? 5 : 3));
    const std::vector<int>& open = constraints.pieces[0].openEnds;
    TEST_ASSERT(std::set<int>(open.begin(), open.end()) == expected);
    const Constraints whole = buildConstraints(mesh, clamped(), {Contact::between("lower_top", "upper_bottom")});
    TEST_ASSERT(whole.pieces[0].openEnds.empty());
  }
}

TEUCHOS_UNIT_TEST(ContactInSpace, GivesItsNodesTheNormalAndTwoTangents) {
  const pairstesting::Turned turn({1, 0.5, -0.3}, 0.8);
  for (const Cell upper : {Cell::Hexahedron8, Cell::Tetrahedron10}) {
    Mesh mesh = facing(Cell::Hexahedron8, 3, 2, upper, 3, 2, 0.01);
    moveAll(mesh, [&](Point p) { return turn(p); });
    const Constraints constraints = buildConstraints(mesh, clamped(), {Contact::between("lower_top", "upper_bottom")});
    int framed = 0;
    for (const NodeRule& rule : constraints.rules) {
      if (rule.fixed[0]) continue;
      ++framed;
      TEST_COMPARE(norm(minus(rule.axes[0], turn({0, 0, 1}))), <, 1e-13);
      const Matrix q = axesOf(rule, 3);
      TEST_COMPARE((q * q.transpose() - Matrix::Identity(3, 3)).norm(), <, 1e-14);
      TEST_FLOATING_EQUALITY(q.determinant(), 1.0, 1e-14);
    }
    TEST_EQUALITY(framed, upper == Cell::Hexahedron8 ? 24 : 12 + 35);
    // A row gives the gap for any displacement: here for a linear one.
    const auto u = [](const Point& p) -> Point { return {0.1 * p[0] - 0.2 * p[2], 0.3 * p[1], 0.05 * p[0] + 0.2 * p[1]}; };
    std::map<int, const NodeRule*> rules;
    for (const NodeRule& rule : constraints.rules) rules[rule.node] = &rule;
    for (const ContactRow& row : contactRows(mesh, constraints)) {
      double of = 0, expected = 0;
      const ContactRow::Equation& normal = row.normal();
      for (std::size_t k = 0; k < normal.dofs.size(); ++k) {
        const int node = int(normal.dofs[k] / 3), component = int(normal.dofs[k] % 3);
        of += normal.coefficients[k] * dot(rules.at(node)->axes[component], u(mesh.point(node)));
      }
      for (const PairEnd& end : row.pair.ends) expected += end.weight * dot(row.pair.normal, u(mesh.point(end.node)));
      TEST_COMPARE(std::abs(of - expected), <, 1e-13);
      TEST_EQUALITY(normal.dofs.size(), row.pair.ends.size());  // one coefficient on a node that has the pair's axes
    }
  }
}

// A block on three symmetry planes of a floor cannot rotate or slide; on contact alone six motions are free.
TEUCHOS_UNIT_TEST(ContactInSpace, LeavesSixMotionsOfABodyThatOnlyContactHolds) {
  const Mesh mesh = facing(Cell::Hexahedron8, 2, 2, Cell::Hexahedron8, 2, 2, 0.0);
  const std::vector<Contact> contact{Contact::between("lower_top", "upper_bottom")};
  std::vector<Condition> conditions = clamped();
  const auto free = [&] { return freeRigidMotions(mesh, buildConstraints(mesh, conditions, contact)).parts; };
  TEST_EQUALITY(free()[0].free.cols(), 0);
  TEST_EQUALITY(free()[1].free.cols(), 6);
  conditions.push_back(Condition::bilateral("upper_left"));
  TEST_EQUALITY(free()[1].free.cols(), 3);
  conditions.push_back(Condition::bilateral("upper_front"));
  const std::vector<RigidPart> parts = free();
  TEST_EQUALITY(parts[1].free.cols(), 1);
  Vector motion = parts[1].free.col(0);
  if (motion[2] < 0) motion = -motion;
  TEST_EQUALITY(inWords(parts[1], motion, 3), "move upwards (0, 0, 1)");
}
