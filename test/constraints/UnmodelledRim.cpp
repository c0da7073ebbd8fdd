#include <Teuchos_UnitTestHarness.hpp>

#include "ConstraintsTesting.hpp"

namespace {

using namespace constraintstesting;

/// Two blocks [0, 4] x [0, 1] and [0, 4] x [1, 2]; the sides between them form two groups per block, left and right of x = 2.
Mesh blocks(Cell cell = Cell::Triangle3) {
  Mesh mesh = stack(2, 8, cell);
  for (const std::string name : {"b0_top", "b1_bottom"})
    for (const Side& side : sidesOf(mesh.sideGroups, {name})) {
      double middle = 0;
      const std::vector<int> nodes = mesh.nodesOf(side);
      for (const int node : {nodes[0], nodes[1]}) middle += 0.5 * mesh.point(node)[0];
      mesh.sideGroups[name + (middle < 2 ? "_left" : "_right")].push_back(side);
    }
  return mesh;
}

std::vector<double> openEnds(const Mesh& mesh, const std::string& contacts, const std::string& conditions = "") {
  std::vector<double> places;
  const Constraints constraints = build(mesh, conditions, contacts);
  for (const ContactPiece& piece : constraints.pieces)
    for (const int id : piece.openEnds) places.push_back(constraints.pairs[id].position[0]);
  return places;
}

const std::vector<double> none, middle{2.0};

TEUCHOS_UNIT_TEST(UnmodelledRim, AreWhereBothBoundariesGoOn) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral9}) {
    const Mesh mesh = blocks(cell);
    for (const std::string coupling : {"Matching Nodes", "Mortar"}) {
      const auto joint = [&](const std::string& a, const std::string& b) {
        return entry("joint", {{"Side A", a}, {"Side B", b}, {"Coupling", coupling}});
      };
      TEST_ASSERT(openEnds(mesh, joint("b1_bottom", "b0_top")) == none);  // corners at both ends
      TEST_ASSERT(openEnds(mesh, joint("b1_bottom_left", "b0_top_left")) == middle);
    }
    TEST_ASSERT(openEnds(mesh, entry("joint", {{"Side A", "b1_bottom_left"}, {"Side B", "b0_top"}, {"Coupling", "Mortar"}})) == middle);
  }
}

TEUCHOS_UNIT_TEST(UnmodelledRim, AreNoneWhereAContactOrAConditionGoesOn) {
  const Mesh mesh = blocks();
  const std::string left = contact("left", "b1_bottom_left", "b0_top_left");
  TEST_ASSERT(openEnds(mesh, left + contact("right", "b1_bottom_right", "b0_top_right")) == none);
  TEST_ASSERT(openEnds(mesh, left, bilateral("beside", "b1_bottom_right")) == none);
}

TEUCHOS_UNIT_TEST(UnmodelledRim, AreNoneAtACorner) {
  Mesh mesh = blocks();
  // The upper block bends upwards by 60 degrees at x = 2.
  move(mesh, 1, [](Point p) { return p[0] <= 2 ? p : Point{2 + 0.5 * (p[0] - 2), p[1] + 0.866 * (p[0] - 2), 0}; });
  TEST_ASSERT(openEnds(mesh, contact("left", "b1_bottom_left", "b0_top_left")) == none);
}

TEUCHOS_UNIT_TEST(UnmodelledRim, OfOneBodyBeforeAnObstacle) {
  const Mesh mesh = blocks();
  const Contact floor = Contact::with(Obstacle::line({0, 1, 0}, {0, 1, 0}), "b1_bottom_left");
  Condition held;
  held.type = Condition::Type::Bilateral;
  held.groups = {"b0_bottom"};
  const Constraints constraints = buildConstraints(mesh, {held}, {floor});
  TEST_EQUALITY(constraints.pieces.size(), 1u);
  TEST_EQUALITY(constraints.pieces[0].openEnds.size(), 1u);
}

}  // namespace
