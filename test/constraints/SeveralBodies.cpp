// Contacts whose sides are several groups, on several bodies.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <map>
#include <set>

#include "ConstraintsTesting.hpp"

namespace {

using namespace constraintstesting;

/// A beam [0, 4] x [1, 2] of ten cells on blocks: left [0.25, middle] x [0, 1] of four cells, right [from, 3.5] x [0, 1] of three.
Mesh beamOnBlocks(double middle, double from, Cell cell = Cell::Triangle3) {
  Box beam, left, right;
  beam.name = "beam", beam.x1 = 4, beam.y0 = 1, beam.y1 = 2, beam.nx = 10, beam.ny = 2, beam.cell = cell;
  left.name = "left", left.x0 = 0.25, left.x1 = middle, left.nx = 4, left.ny = 2, left.cell = cell;
  right.name = "right", right.x0 = from, right.x1 = 3.5, right.nx = 3, right.ny = 2, right.cell = cell;
  Mesh mesh = boxes({beam, left, right});
  assignBodies(mesh, {"beam", "left", "right"});
  return mesh;
}

std::string seat(const std::string& carrier) {
  return entry("seat", {{"Side A", "beam_bottom"}, {"Side B", "{left_top, right_top}"}, {"Multipliers On", carrier}});
}

std::set<int> bodiesOf(const Mesh& mesh, const ContactPair& pair) {
  std::set<int> bodies;
  for (const PairEnd& end : pair.ends) bodies.insert(mesh.bodyOfNode[end.node]);
  return bodies;
}

TEUCHOS_UNIT_TEST(SeveralBodies, CarryABeamOnTwoBlocksInTwoPieces) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral9})
    for (const std::string carrier : {"Side A", "Side B", "Automatic"}) {
      const Mesh mesh = beamOnBlocks(1.5, 2.5, cell);
      const Constraints constraints = build(mesh, "", seat(carrier));
      TEST_EQUALITY(constraints.pieces.size(), 2u);
      TEST_EQUALITY(constraints.pieces[0].name, "seat");
      TEST_EQUALITY(constraints.pieces[1].name, "seat 2");
      for (const ContactPiece& piece : constraints.pieces) {
        TEST_EQUALITY(piece.bodies.size(), 2u);
        double length = 0, moment = 0;
        for (const int id : piece.pairs) {
          const ContactPair& pair = constraints.pairs[id];
          length += pair.length;
          for (const PairEnd& end : pair.ends)  // force and moment of a constant pressure on the beam
            if (mesh.bodyOfNode[end.node] == 0) moment += end.weight * pair.length * mesh.point(end.node)[0];
          TEST_ASSERT(bodiesOf(mesh, pair) == std::set<int>(piece.bodies.begin(), piece.bodies.end()));
          TEST_COMPARE(norm(minus(pair.normal, {0, -1, 0})), <, 1e-15);
        }
        const bool isLeft = piece.bodies.back() == 1;
        TEST_FLOATING_EQUALITY(length, isLeft ? 1.25 : 1.0, 1e-12);
        TEST_FLOATING_EQUALITY(moment, isLeft ? 1.25 * 0.875 : 3.0, 1e-10);
      }
    }
}

TEUCHOS_UNIT_TEST(SeveralBodies, AreOnePieceWhereTheBlocksTouch) {
  const Mesh mesh = beamOnBlocks(1.5, 1.5);
  const Constraints constraints = build(mesh, "", seat("Side A"));
  TEST_EQUALITY(constraints.pieces.size(), 1u);
  TEST_ASSERT(constraints.pieces[0].bodies == (std::vector<int>{0, 1, 2}));
  TEST_EQUALITY(constraints.pieces[0].cells.size() + 1, constraints.pairs.size());
  int overTheJoint = 0;
  double length = 0;
  for (const ContactPair& pair : constraints.pairs) {
    overTheJoint += bodiesOf(mesh, pair).size() == 3;
    length += pair.length;
    double a = 0, b = 0;
    for (const PairEnd& end : pair.ends) (mesh.bodyOfNode[end.node] == 0 ? a : b) += end.weight;
    TEST_FLOATING_EQUALITY(a, 1.0, 1e-12);
    TEST_FLOATING_EQUALITY(b, -1.0, 1e-12);
  }
  TEST_EQUALITY(overTheJoint, 2);  // the beam's nodes at 1.2 and 1.6
  TEST_FLOATING_EQUALITY(length, 3.25, 1e-12);
}

// Joints of a stack named as one contact: the middle bodies are on both of its sides.
TEUCHOS_UNIT_TEST(SeveralBodies, MayBeOnBothSidesOfOneContact) {
  const Mesh mesh = stack(4);
  for (const std::string coupling : {"Matching Nodes", "Mortar"}) {
    const Constraints together = build(
        mesh, "",
        entry("joints", {{"Side A", "{b0_top, b1_top, b2_top}"}, {"Side B", "{b1_bottom, b2_bottom, b3_bottom}"}, {"Coupling", coupling}}));
    std::string each;
    for (int k = 0; k < 3; ++k)
      each += entry(
          "joint" + std::to_string(k),
          {{"Side A", "b" + std::to_string(k) + "_top"}, {"Side B", "b" + std::to_string(k + 1) + "_bottom"}, {"Coupling", coupling}});
    const Constraints apart = build(mesh, "", each);
    TEST_EQUALITY(together.pairs.size(), apart.pairs.size());
    TEST_EQUALITY(together.pieces.size(), 3u);
    for (std::size_t i = 0; i < std::min(together.pairs.size(), apart.pairs.size()); ++i) {
      const ContactPair &one = together.pairs[i], &other = apart.pairs[i];
      TEST_EQUALITY(one.node(), other.node());
      TEST_EQUALITY(one.ends.size(), other.ends.size());
      TEST_EQUALITY(one.gap, other.gap);
      TEST_EQUALITY(one.length, other.length);
      TEST_EQUALITY(one.piece, other.piece);
      TEST_EQUALITY(bodiesOf(mesh, one).size(), 2u);
    }
  }
}

TEUCHOS_UNIT_TEST(SeveralBodies, MatchPartByPart) {
  // Two blocks under two others, as one contact: its parts follow the order of side A.
  Box box;
  std::vector<Box> all;
  for (const char* name : {"a", "b", "c", "d"}) {
    box.name = name, box.nx = box.ny = 2;
    box.x0 = name[0] == 'a' || name[0] == 'd' ? 0 : 3, box.x1 = box.x0 + 1;
    box.y0 = name[0] < 'c' ? 0 : 1, box.y1 = box.y0 + 1;
    all.push_back(box);
  }
  Mesh mesh = boxes(all);
  assignBodies(mesh, {"a", "b", "c", "d"});
  const Constraints constraints =
      build(mesh, "", entry("c", {{"Side A", "{a_top, b_top}"}, {"Side B", "{c_bottom, d_bottom}"}, {"Coupling", "Matching Nodes"}}));
  TEST_EQUALITY(constraints.pairs.size(), 6u);
  TEST_ASSERT(constraints.pieces[0].bodies == (std::vector<int>{0, 3}));
  TEST_ASSERT(constraints.pieces[1].bodies == (std::vector<int>{1, 2}));
  for (const ContactPair& pair : constraints.pairs) TEST_EQUALITY(pair.gap, 0.0);
}

TEUCHOS_UNIT_TEST(SeveralBodies, MayFaceOneObstacle) {
  const Mesh mesh = beamOnBlocks(1.5, 2.5);
  const std::string ground =
      "<ParameterList name=\"Line\"><Parameter name=\"Point\" value=\"{0, -0.5}\"/><Parameter name=\"Normal\" "
      "value=\"{0, 1}\"/></ParameterList>";
  const std::string contact =
      "<ParameterList name=\"ground\"><Parameter name=\"Side A\" value=\"{left_bottom, right_bottom}\"/><Parameter "
      "name=\"Obstacle\" value=\"Line\"/>" +
      ground + "</ParameterList>";
  const Constraints constraints = build(mesh, displacement("d", "beam_top", "{0, 0}"), contact);
  TEST_EQUALITY(constraints.pairs.size(), 5u + 4u);
  TEST_ASSERT(constraints.pieces[0].bodies == std::vector<int>{1});
  TEST_ASSERT(constraints.pieces[1].bodies == std::vector<int>{2});
}

TEUCHOS_UNIT_TEST(SeveralGroups, OfOneConditionAreAsSeveralConditions) {
  const Mesh mesh = stack(2);
  const std::string joint = contact("joint", "b0_top", "b1_bottom");
  const Constraints together =
      build(mesh, displacement("d", "{b0_left, b0_right, b0_left}", "{1, 2}") + bilateral("r", "{b1_left, b1_top}"), joint);
  const Constraints apart = build(mesh,
                                  displacement("d", "b0_left", "{1, 2}") + displacement("e", "b0_right", "{1, 2}") +
                                      bilateral("r", "b1_left") + bilateral("s", "b1_top"),
                                  joint);
  TEST_EQUALITY(together.rules.size(), apart.rules.size());
  for (std::size_t i = 0; i < together.rules.size(); ++i) {
    TEST_EQUALITY(together.rules[i].node, apart.rules[i].node);
    TEST_ASSERT(together.rules[i].fixed == apart.rules[i].fixed && together.rules[i].value == apart.rules[i].value);
    TEST_ASSERT(together.rules[i].axes == apart.rules[i].axes);
  }
  SUTURE_CHECK_SAYS(said(mesh, bilateral("r", "{b1_left, b1_topp}")), "no such curve group 'b1_topp'");
  SUTURE_CHECK_SAYS(said(mesh, bilateral("r", "{b0_bottom, b1_bottom}"), joint),
                    "Contact/joint/Side B: 'b1_bottom' is held on its whole length");
}

}  // namespace
