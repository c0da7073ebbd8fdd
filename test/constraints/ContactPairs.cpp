#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>

#include <set>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

// Both bodies of a stack bent to rings about the origin: body 0 from radius 1 to 2 (top outside), body 1 beyond. `whole`: nodes of the two
// ends are merged. The angle grows with -x, so that elements stay positive.
Mesh rings(int nx, double sweep, double clearance) {
  Mesh mesh = stack(2, nx);
  for (int body = 0; body < 2; ++body)
    move(mesh, body, [&](Point p) -> Point {
      const double angle = -p[0] / 4 * sweep, r = 1 + p[1] + (body == 1 ? clearance : 0.0);
      return {r * std::cos(angle), r * std::sin(angle), 0};
    });
  return mesh;
}

// Glues the ends of whole rings: nodes at x = 4 take the numbers of those at x = 0. Side groups of the ends vanish.
Mesh closed(Mesh mesh, int nx) {
  std::vector<int> number(mesh.nodes());
  Mesh out = mesh;
  out.coordinates.clear();
  out.bodyOfNode.clear();
  int next = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const bool last = i % (nx + 1) == nx;
    number[i] = last ? number[i - nx] : next++;
    if (last) continue;
    out.coordinates.insert(out.coordinates.end(), {mesh.coordinates[2 * i], mesh.coordinates[2 * i + 1]});
    out.bodyOfNode.push_back(mesh.bodyOfNode[i]);
  }
  for (int& node : out.connectivity) node = number[node];
  for (const char* name : {"b0_left", "b0_right", "b1_left", "b1_right"}) out.sideGroups.erase(name);
  assignBodies(out, out.bodies);
  return out;
}

const std::string joint = contact("joint", "b0_top", "b1_bottom");

}  // namespace

TEUCHOS_UNIT_TEST(ContactPairs, FaceEachOtherOnAStraightLine) {
  const Mesh mesh = stack(2);
  const Constraints constraints = build(mesh, "", joint);
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(9));
  TEST_EQUALITY(constraints.pieces.size(), std::size_t(1));
  TEST_EQUALITY(constraints.pieces[0].name, "joint");
  double arc = -1, length = 0;
  for (const ContactPair& pair : constraints.pairs) {
    TEST_EQUALITY(pair.id, static_cast<int>(&pair - constraints.pairs.data()));
    TEST_EQUALITY(mesh.bodyOfNode[pair.ends[0].node], 0);
    TEST_EQUALITY(mesh.bodyOfNode[pair.ends[1].node], 1);
    TEST_ASSERT(mesh.point(pair.ends[0].node) == mesh.point(pair.ends[1].node));
    TEST_ASSERT((pair.normal == Point{0, 1, 0}));
    TEST_EQUALITY(pair.gap, 0.0);
    TEST_COMPARE(pair.arc, >, arc);
    TEST_FLOATING_EQUALITY(pair.arc, 4 - pair.position[0], 1e-14);  // the body on the left: from right to left along its top
    arc = pair.arc;
    const bool end = pair.position[0] == 0 || pair.position[0] == 4;
    TEST_FLOATING_EQUALITY(pair.length, end ? 0.25 : 0.5, 1e-13);
    length += pair.length;
  }
  TEST_FLOATING_EQUALITY(length, 4.0, 1e-13);
}

TEUCHOS_UNIT_TEST(ContactPairs, WeighQuadraticSidesBySimpson) {
  const Constraints constraints = build(stack(2, 2, Cell::Triangle6), "", joint);
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(5));
  const double expected[] = {1.0 / 3, 4.0 / 3, 2.0 / 3, 4.0 / 3, 1.0 / 3};
  for (int i = 0; i < 5; ++i) TEST_FLOATING_EQUALITY(constraints.pairs[i].length, expected[i], 1e-13);
}

TEUCHOS_UNIT_TEST(ContactPairs, SwappingTheSidesFlipsTheNormalOnly) {
  Mesh mesh = rings(24, pi / 2, 0.01);
  const Constraints one = build(mesh, "", joint), other = build(mesh, "", contact("joint", "b1_bottom", "b0_top"));
  TEST_EQUALITY(one.pairs.size(), other.pairs.size());
  for (const ContactPair& pair : one.pairs) {
    const ContactPair& same = other.pairs[other.pairs.size() - 1 - pair.id];
    TEST_EQUALITY(same.ends[0].node, pair.ends[1].node);
    TEST_EQUALITY(same.ends[1].node, pair.ends[0].node);
    for (int k = 0; k < 2; ++k) TEST_EQUALITY(same.normal[k], -pair.normal[k]);
    TEST_EQUALITY(same.gap, pair.gap);
  }
}

TEUCHOS_UNIT_TEST(ContactPairs, MeasureGapAndInterferenceAlongTheNormal) {
  for (const double clearance : {0.05, -0.02}) {
    const Mesh mesh = rings(24, pi / 2, clearance);
    const Constraints constraints = build(mesh, "", joint);
    TEST_EQUALITY(constraints.pairs.size(), std::size_t(25));
    for (const ContactPair& pair : constraints.pairs) {
      const double r = std::hypot(pair.position[0], pair.position[1]);
      const bool end = pair.id == 0 || pair.id == 24;
      if (end) continue;  // one-sided normals there
      TEST_FLOATING_EQUALITY(pair.gap, clearance, 1e-12);
      TEST_FLOATING_EQUALITY(pair.normal[0], pair.position[0] / r, 1e-12);
      TEST_FLOATING_EQUALITY(pair.normal[1], pair.position[1] / r, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactPairs, CloseARing) {
  const int n = 32;
  for (const double clearance : {0.0, 0.1}) {
    const Mesh mesh = closed(rings(n, 2 * pi, clearance), n);
    const Constraints constraints = build(mesh, "", joint);
    TEST_EQUALITY(constraints.pairs.size(), std::size_t(n));
    TEST_EQUALITY(constraints.pieces.size(), std::size_t(1));
    const double step = 2 * 2 * std::sin(pi / n);  // chord at radius 2
    for (const ContactPair& pair : constraints.pairs) {
      TEST_FLOATING_EQUALITY(pair.length, step, 1e-12);
      TEST_FLOATING_EQUALITY(pair.arc + 1, pair.id * step + 1, 1e-12);
      TEST_COMPARE(std::abs(pair.gap - clearance), <, 1e-13);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactPairs, MatchACylinderOverAPlaneByTheSameX) {
  // the upper body's bottom becomes a circle of radius R that touches y = 1 in x = 2; nodes keep their x
  const double R = 6;
  Mesh mesh = stack(2, 64);
  const auto lift = [&](double x) { return R - std::sqrt(R * R - (x - 2) * (x - 2)); };
  move(mesh, 1, [&](Point p) -> Point { return {p[0], p[1] + lift(p[0]), 0}; });
  const Constraints constraints = build(mesh, "", joint);
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(65));
  for (const ContactPair& pair : constraints.pairs) {
    TEST_EQUALITY(mesh.point(pair.ends[0].node)[0], mesh.point(pair.ends[1].node)[0]);
    const double x = pair.position[0] - 2;
    if (pair.id == 0 || pair.id == 64) continue;
    // along the line between the nodes, which lies between the normals of the two sides: forces along it have no moment
    TEST_COMPARE(std::abs(pair.normal[0]), <, 1e-9);
    TEST_FLOATING_EQUALITY(pair.gap + 1, lift(x + 2) + 1, 1e-12);
  }
}

// The integral of the hat function times r vanishes at the end of a second-order side on the axis: 2 pi (1/2 - 1 + 1/2) h^2.
TEUCHOS_UNIT_TEST(ContactPairs, LeaveOutANodeOnTheAxisWithoutTributaryArea) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral8})
    for (const std::string coupling : {"Matching Nodes", "Mortar"}) {
      Mesh mesh = stack(2, 8, cell);
      makeAxisymmetric(mesh);
      const Constraints constraints =
          build(mesh, "", entry("joint", {{"Side A", "b0_top"}, {"Side B", "b1_bottom"}, {"Coupling", coupling}}));
      TEST_EQUALITY(constraints.pairs.size(), cell == Cell::Triangle3 ? std::size_t(9) : std::size_t(16));
      double area = 0;
      for (const ContactPair& pair : constraints.pairs) {
        TEST_EQUALITY(constraints.pairs[pair.id].id, pair.id);
        TEST_COMPARE(pair.length, >, 0.1);
        area += pair.length;
      }
      TEST_FLOATING_EQUALITY(area, pi * 16, 1e-12);
      const std::vector<AxisPoint>& onAxis = constraints.pieces[0].onAxis;
      TEST_EQUALITY(onAxis.size(), cell == Cell::Triangle3 ? std::size_t(0) : std::size_t(1));
      if (onAxis.size() != 1) continue;
      // Sides of length h: means of r^2 are 2/5 h^2 in the middle of the first and 7/10 h^2 at its end; the nodes are at h/2 and h.
      TEST_EQUALITY(constraints.pairs[onAxis[0].pairs[0]].position[0], 0.25);
      TEST_EQUALITY(constraints.pairs[onAxis[0].pairs[1]].position[0], 0.5);
      TEST_FLOATING_EQUALITY(onAxis[0].pressure[0], 7.0 / 3.0, 1e-12);
      TEST_FLOATING_EQUALITY(onAxis[0].pressure[1], -4.0 / 3.0, 1e-12);
      TEST_FLOATING_EQUALITY(onAxis[0].value[0], 4.0 / 3.0, 1e-12);
      TEST_EQUALITY(onAxis[0].position[0], 0.0);
    }
}

TEUCHOS_UNIT_TEST(ContactPairs, CountAndLocateNodesWithoutPartner) {
  std::vector<Box> all(2);
  all[0].name = "b0", all[0].x1 = 4, all[0].nx = 8, all[0].ny = 2;
  all[1].name = "b1", all[1].x1 = 4, all[1].nx = 12, all[1].ny = 2, all[1].y0 = 1, all[1].y1 = 2;
  const std::string text = said(boxes(all), "", matching("joint", "b0_top", "b1_bottom"));
  SUTURE_CHECK_SAYS(
      text, "Contact/joint: the sides do not match: 'b0_top' has 9 nodes, 'b1_bottom' has 13 nodes; 4 and 8 of them have no partner");
  SUTURE_CHECK_SAYS(text, "shifted by 0.167 along the line = 0.5 of the local mesh size");
}

TEUCHOS_UNIT_TEST(ContactPairs, RefuseSidesThatAreShiftedAlongTheLine) {
  Mesh mesh = stack(2);
  move(mesh, 1, [](Point p) -> Point { return {p[0] + 0.01, p[1], 0}; });
  const std::string text = said(mesh, "", matching("joint", "b0_top", "b1_bottom"));
  SUTURE_CHECK_SAYS(text, "9 and 9 of them have no partner");
  SUTURE_CHECK_SAYS(text, "shifted by 0.01 along the line = 0.02 of the local mesh size (Tolerance 0.001)");
  TEST_EQUALITY(
      said(mesh, "",
           entry("joint", {{"Side A", "b0_top"}, {"Side B", "b1_bottom"}, {"Coupling", "Matching Nodes"}, {"Tolerance", "0.05"}})),
      "no error");
}

TEUCHOS_UNIT_TEST(ContactPairs, RefuseSidesThatDoNotFaceEachOther) {
  SUTURE_CHECK_SAYS(said(stack(2), "", matching("joint", "b0_top", "b1_top")), "do not face each other");
}

TEUCHOS_UNIT_TEST(ContactPairs, RefuseSidesInContradictoryRoles) {
  Mesh mesh = stack(3);
  std::vector<Side> corner = mesh.sideGroups.at("b0_top");
  corner.insert(corner.end(), mesh.sideGroups.at("b0_left").begin(), mesh.sideGroups.at("b0_left").end());
  mesh.sideGroups["corner"] = corner;
  mesh.sideGroups["inside"] = {Side{0, 2}};
  mesh.sideGroups["nothing"];

  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "b0_topp", "b1_bottom")),
                    "Contact/c/Side A: in the mesh boxes: no such curve group 'b0_topp'. Did you mean 'b0_top'?");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "b0_top", "b0_top")), "Contact/c/Side B: 'b0_top' is also Side A");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "corner", "b1_bottom")), "'corner' turns by 90 degrees at (0, 1)");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "{b0_top, b0_left}", "b1_bottom")), "'b0_top' + 'b0_left' turns by 90 degrees at (0, 1)");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "{b0_top, b1_topp}", "b1_bottom")),
                    "no such curve group 'b1_topp'. Did you mean 'b1_top'?");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "{b0_top, b1_top}", "{b2_bottom, b1_top}")), "'b1_top' is also Side A");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "{}", "b1_bottom")), "Contact/c/Side A: is empty");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "inside", "b1_bottom")), "'inside' lies inside the material");
  SUTURE_CHECK_SAYS(said(mesh, "", contact("c", "nothing", "b1_bottom")), "is empty");
  SUTURE_CHECK_SAYS(said(mesh, "", joint + contact("again", "b0_top", "b1_bottom")),
                    "Contact/again/Side A: 'b0_top' meets, entirely or partly, sides of 'b1_bottom' also in Contact/joint");
  TEST_EQUALITY(said(mesh, "", joint + contact("another", "b2_bottom", "b1_bottom")).find("also in"), std::string::npos);
  SUTURE_CHECK_SAYS(said(mesh, displacement("d", "b0_top", "{0, 0}"), joint),
                    "Contact/joint/Side A: 'b0_top' is held on its whole length by Boundary Conditions/d");
  SUTURE_CHECK_SAYS(said(mesh, bilateral("d", "b1_bottom"), joint),
                    "Contact/joint/Side B: 'b1_bottom' is held on its whole length by Boundary Conditions/d");
  SUTURE_CHECK_SAYS(
      said(mesh, displacement("d", "b0_bottom", "{0, 0}") + entry("p", {{"Type", "Pressure"}, {"Group", "b0_bottom"}, {"Value", "1"}}),
           joint),
      "Boundary Conditions/p/Group: all displacements of 'b0_bottom' are prescribed by Boundary Conditions/d");
}

TEUCHOS_UNIT_TEST(ContactPairs, ReportAllProblemsAtOnce) {
  const std::string text =
      said(stack(2), bilateral("a", "nowhere"), contact("c", "b0_top", "elsewhere") + contact("d", "b0_topp", "b1_top"));
  SUTURE_CHECK_SAYS(text, "Boundary Conditions/a/Group: ");
  SUTURE_CHECK_SAYS(text, "Contact/c/Side B: ");
  SUTURE_CHECK_SAYS(text, "Contact/d/Side A: ");
}

TEUCHOS_UNIT_TEST(BuildConstraints, NamesEveryBodyThatNothingHolds) {
  const Mesh mesh = stack(3);
  const std::string text = said(mesh, "");
  for (const char* body : {"b0", "b1", "b2"}) SUTURE_CHECK_SAYS(text, std::string("Bodies/") + body + ": nothing holds this body");
  const std::string one = said(mesh, bilateral("a", "b0_bottom"), joint);
  TEST_EQUALITY(one.find("Bodies/b2: nothing holds"), std::size_t(0));
}

TEUCHOS_UNIT_TEST(ContactPieces, AreOneForEachConnectedPart) {
  // the middle elements of the joint are not named: two parts
  Mesh mesh = stack(2);
  for (const char* name : {"b0_top", "b1_bottom"}) {
    std::vector<Side>& sides = mesh.sideGroups[name];
    std::vector<Side> kept;
    for (const Side& side : sides) {
      const double x = (mesh.point(mesh.nodesOf(side)[0])[0] + mesh.point(mesh.nodesOf(side)[1])[0]) / 2;
      if (x < 1 || x > 2.5) kept.push_back(side);
    }
    sides = kept;
  }
  const Constraints constraints = build(mesh, "", joint);
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(3 + 4));
  TEST_EQUALITY(constraints.pieces.size(), std::size_t(2));
  std::set<std::string> names;
  for (const ContactPiece& piece : constraints.pieces) {
    names.insert(piece.name);
    TEST_ASSERT(piece.bodies == (std::vector<int>{0, 1}));
    TEST_EQUALITY(piece.cells.size() + 1, piece.pairs.size());
    for (const int id : piece.pairs) TEST_EQUALITY(&constraints.pieces[constraints.pairs[id].piece], &piece);
  }
  TEST_ASSERT((names == std::set<std::string>{"joint", "joint 2"}));
}

TEUCHOS_UNIT_TEST(ContactPieces, AreOneForLinesThatTouch) {
  // one joint named in two lines that share the node x = 2
  Mesh mesh = stack(2);
  for (const std::string name : {"b0_top", "b1_bottom"})
    for (const Side& side : mesh.sideGroups.at(name)) {
      const double x = (mesh.point(mesh.nodesOf(side)[0])[0] + mesh.point(mesh.nodesOf(side)[1])[0]) / 2;
      mesh.sideGroups[name + (x < 2 ? " left" : " right")].push_back(side);
    }
  const Constraints constraints =
      build(mesh, "", contact("east", "b0_top right", "b1_bottom right") + contact("west", "b0_top left", "b1_bottom left"));
  TEST_EQUALITY(constraints.pairs.size(), std::size_t(5 + 5));
  TEST_EQUALITY(constraints.pieces.size(), std::size_t(1));
  TEST_EQUALITY(constraints.pieces[0].name, "east + west");
  TEST_EQUALITY(constraints.pairs.front().line, 0);
  TEST_EQUALITY(constraints.pairs.back().line, 1);
  // the shared node is in two pairs: Cartesian axes
  TEST_ASSERT(ruleAt(constraints, nodeAt(mesh, 0, 2, 1)) == nullptr);
  TEST_ASSERT(ruleAt(constraints, nodeAt(mesh, 0, 1, 1)) != nullptr);
}

TEUCHOS_UNIT_TEST(ContactPieces, AreOneForEachLayer) {
  const Constraints constraints = build(stack(4), "", joint + contact("j2", "b1_top", "b2_bottom") + contact("j3", "b2_top", "b3_bottom"));
  TEST_EQUALITY(constraints.pieces.size(), std::size_t(3));
  TEST_EQUALITY(constraints.pieces[2].name, "j3");
  TEST_ASSERT(constraints.pieces[1].bodies == (std::vector<int>{1, 2}));
}

TEUCHOS_UNIT_TEST(ContactFrames, FollowTheNormalUnlessSomethingIsPrescribed) {
  const Mesh mesh = rings(24, pi / 2, 0.0);
  const Constraints constraints = build(mesh, bilateral("symmetry", "b0_left") + displacement("hold", "b1_top", "{0, 0}"), joint);
  int frames = 0;
  for (const ContactPair& pair : constraints.pairs)
    for (const int node : {pair.ends[0].node, pair.ends[1].node}) {
      const NodeRule& rule = *ruleAt(constraints, node);
      if (rule.fixed[0] || rule.fixed[1]) {
        TEST_ASSERT(node == nodeAt(mesh, 0, 2, 0));  // the roller meets the joint here
        TEST_ASSERT(axesOf(rule, 2) == Matrix::Identity(2, 2));
        continue;
      }
      ++frames;
      TEST_ASSERT(rule.axes[0] == pair.normal);
      TEST_FLOATING_EQUALITY(axesOf(rule, 2).determinant(), 1.0, 1e-14);
    }
  TEST_EQUALITY(frames, 49);
  for (std::size_t i = 1; i < constraints.rules.size(); ++i) TEST_COMPARE(constraints.rules[i - 1].node, <, constraints.rules[i].node);
}
