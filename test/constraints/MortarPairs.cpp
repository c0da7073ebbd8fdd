// Mortar pairs: conditions for displacements and gaps that are known everywhere.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/Surface.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "MortarScenes.hpp"

namespace {

using namespace constraintstesting;

TEUCHOS_UNIT_TEST(MortarPairs, WeighsBothSidesByOneInAll) {
  for (const Case& c : cases)
    for (const std::string carrier : {"Side A", "Side B"}) {
      const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
      const Constraints constraints = build(mesh, held, mortar(carrier));
      TEST_COMPARE(constraints.pairs.size(), >, 2);
      for (const ContactPair& pair : constraints.pairs) {
        TEST_FLOATING_EQUALITY(sum(mesh, pair, 0, [](Point) { return 1.0; }), 1.0, 1e-11);
        TEST_FLOATING_EQUALITY(sum(mesh, pair, 1, [](Point) { return 1.0; }), -1.0, 1e-11);
        TEST_EQUALITY(mesh.bodyOfNode[pair.node()], carrier == "Side A" ? 0 : 1);
        const bool covered = c.x0 >= 0 && c.x1 <= 4 && carrier == "Side A";  // all of it: no psi is handed on
        if (covered) TEST_FLOATING_EQUALITY(pair.ends[0].weight, 1.0, 1e-11);
        TEST_EQUALITY(pair.normal[1], -1.0);  // from A, above, to B
        TEST_COMPARE(std::abs(pair.gap), <, 1e-14);
        TEST_COMPARE(pair.length, >, 0.0);
      }
    }
}

TEUCHOS_UNIT_TEST(MortarPairs, IsClosedByLinearDisplacementsThatAgreeOnBothSides) {
  for (const Case& c : cases) {
    const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    for (const std::string carrier : {"Side A", "Side B"})
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) {
        const auto field = [](Point p) { return 3.0 * p[0] - 2.0; };
        const double jump = sum(mesh, pair, 0, field) + sum(mesh, pair, 1, field);
        TEST_COMPARE(std::abs(jump), <, 1e-10);
      }
  }
}

TEUCHOS_UNIT_TEST(MortarPairs, HasTheLengthSharedByTheSides) {
  for (const Case& c : cases)
    for (const std::string carrier : {"Side A", "Side B"}) {
      const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
      double length = 0;
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) length += pair.length;
      TEST_FLOATING_EQUALITY(length, std::min(4.0, c.x1) - std::max(0.0, c.x0), 1e-12);
    }
}

// Forces of a constant pressure: each node gets the integral of its shape function over the shared length, on either side. With the
// trapezoidal rule of the hat functions where the other side covers all of it.
TEUCHOS_UNIT_TEST(MortarPairs, PassesAConstantPressureOnToBothSides) {
  for (const Case& c : {cases[0], cases[1], cases[2], cases[5], cases[6], cases[7]}) {
    const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    std::map<int, double> force;
    for (const ContactPair& pair : build(mesh, held, mortar("Side A")).pairs)
      for (const PairEnd& end : pair.ends) force[end.node] += end.weight * pair.length;
    const bool inside = c.x0 > 0;  // then only the upper side is covered completely
    for (const auto& [group, sign] : {std::make_pair("upper_bottom", 1.0), std::make_pair("lower_top", -1.0)}) {
      if (inside && sign < 0) continue;
      const Surface surface(mesh, mesh.sideGroups.at(group));
      for (const auto& [node, data] : surface.nodes()) TEST_FLOATING_EQUALITY(sign * force[node], data.tributary, 1e-11);
    }
  }
}

// Forces act at the positions of their pairs, none of them beyond the end of the partner, and have the resultant and the moment of a
// uniform pressure over the shared part of the sides.
TEUCHOS_UNIT_TEST(MortarPairs, RedistributesTheUncoveredPart) {
  for (const Case& c : cases)
    for (const std::string carrier : {"Side A", "Side B"}) {
      const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
      const double begin = std::max(0.0, c.x0), end = std::min(4.0, c.x1);
      const double size = carrier == "Side A" ? (c.x1 - c.x0) / c.upperCells : 4.0 / c.lowerCells;
      const int body = carrier == "Side A" ? 0 : 1;
      double moment = 0;
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) {
        TEST_COMPARE(pair.position[0], >, begin - 0.1 * size - 1e-12);
        TEST_COMPARE(pair.position[0], <, end + 0.1 * size + 1e-12);
        TEST_COMPARE(pair.length, >, 0.1 * size);
        const double place = (body == 0 ? 1 : -1) * sum(mesh, pair, body, [](Point p) { return p[0]; });
        TEST_FLOATING_EQUALITY(place + 10, pair.position[0] + 10, 1e-12);
        moment += pair.length * pair.position[0];
      }
      TEST_FLOATING_EQUALITY(moment, (end * end - begin * begin) / 2, 1e-11);
    }
}

TEUCHOS_UNIT_TEST(MortarPairs, WarnsOfSidesThatShareAPartOfOneElement) {
  const auto warnings = [](double x0, double x1, const std::string& carrier) {
    int count = 0;
    for (const std::string& note : build(twoBoxes(x0, x1, 3, 2, P1, P1), held, mortar(carrier)).notes)
      count += note.find("warning: contact 'joint': its sides share only part of an element at (") == 0;
    return count;
  };
  TEST_EQUALITY(warnings(0.8, 1.2, "Side B"), 1);  // within [0, 2]
  TEST_EQUALITY(warnings(0.8, 1.2, "Side A"), 0);
  TEST_EQUALITY(warnings(0.8, 1.2, "Automatic"), 0);
  TEST_EQUALITY(warnings(0.8, 2.2, "Side B"), 0);  // the node at 2 takes over
}

TEUCHOS_UNIT_TEST(MortarPairs, IsThePairOfTwoNodesWhereTheyMatch) {
  for (const Cell cell : {P1, P2, Q8}) {
    const Mesh mesh = twoBoxes(0, 4, 8, 8, cell, cell);
    const Constraints matched = build(mesh, held, contact("joint", "upper_bottom", "lower_top")), mean = build(mesh, held, mortar());
    TEST_EQUALITY(matched.pairs.size(), mean.pairs.size());
    TEST_ASSERT(matched.notes.empty());
    for (std::size_t i = 0; i < matched.pairs.size(); ++i) {
      const ContactPair &a = matched.pairs[i], &b = mean.pairs[i];
      TEST_EQUALITY(b.ends.size(), 2u);
      for (int end = 0; end < 2; ++end) {
        TEST_EQUALITY(a.ends[end].node, b.ends[end].node);
        TEST_FLOATING_EQUALITY(a.ends[end].weight, b.ends[end].weight, 1e-11);
      }
      TEST_FLOATING_EQUALITY(a.length, b.length, 1e-12);
      TEST_FLOATING_EQUALITY(a.arc + 1, b.arc + 1, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(MortarPairs, DoesNotChangeWhenTheSceneIsTurned) {
  const auto turn = [](Point p) {
    return Point{p[0] * std::cos(0.7) - p[1] * std::sin(0.7), p[0] * std::sin(0.7) + p[1] * std::cos(0.7), 0};
  };
  Mesh mesh = twoBoxes(-0.7, 3.3, 8, 9, P1, P1);
  const Constraints straight = build(mesh, held, mortar());
  moveAll(mesh, turn);
  const Constraints turned = build(mesh, held, mortar());
  TEST_EQUALITY(straight.pairs.size(), turned.pairs.size());
  for (std::size_t i = 0; i < straight.pairs.size(); ++i) {
    const ContactPair &a = straight.pairs[i], &b = turned.pairs[i];
    const Point n = turn(a.normal);
    for (int k = 0; k < 2; ++k) TEST_COMPARE(std::abs(n[k] - b.normal[k]), <, 1e-13);
    TEST_EQUALITY(a.ends.size(), b.ends.size());
    for (std::size_t end = 0; end < a.ends.size(); ++end) TEST_COMPARE(std::abs(a.ends[end].weight - b.ends[end].weight), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(MortarPairs, TakesTheGapOfAnExpression) {
  const Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
  // psi_j is biorthogonal, so that a linear gap takes its nodal values.
  for (const ContactPair& pair : build(mesh, held, mortar("Side A", {{"Initial Gap", "0.01 * x + y - 1"}})).pairs)
    TEST_FLOATING_EQUALITY(pair.gap + 1, 0.01 * pair.position[0] + 1, 1e-12);
}

TEUCHOS_UNIT_TEST(MortarPairs, IsChosenWithANoteWhereNodesDoNotMatch) {
  const Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
  const Constraints constraints = build(mesh, held, contact("joint", "upper_bottom", "lower_top"));
  TEST_EQUALITY(constraints.pairs.size(), 14u);  // pairs of the finer side
  TEST_EQUALITY(constraints.notes.size(), 1u);
  SUTURE_CHECK_SAYS(constraints.notes[0], "contact 'joint': the nodes of its sides do not match; mortar, carried by 'lower_top'");
  // Carrying nodes have the axes of their pair, the others the mean of their pairs' axes.
  for (const ContactPair& pair : constraints.pairs)
    for (const PairEnd& end : pair.ends) {
      const NodeRule* rule = ruleAt(constraints, end.node);
      TEST_ASSERT(rule != nullptr);
      if (rule) TEST_EQUALITY(rule->axes[0][1], -1.0);
    }
}

TEUCHOS_UNIT_TEST(MortarPairs, ReportsSidesThatOverlapNowhere) {
  const Mesh apart = twoBoxes(4.5, 6, 8, 8, P1, P1);
  SUTURE_CHECK_SAYS(said(apart, held, mortar()), "Contact/joint: the sides 'upper_bottom' and 'lower_top' overlap nowhere");
  const Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
  SUTURE_CHECK_SAYS(said(mesh, held, entry("joint", {{"Side A", "upper_top"}, {"Side B", "lower_top"}, {"Coupling", "Mortar"}})),
                    "overlap nowhere");
}

TEUCHOS_UNIT_TEST(MortarPairs, RefusesNodesOfAnotherOrderAsMatching) {
  const Mesh mesh = twoBoxes(0, 4, 8, 16, P2, P1);  // the same nodes
  const std::string text =
      said(mesh, held, entry("joint", {{"Side A", "upper_bottom"}, {"Side B", "lower_top"}, {"Coupling", "Matching Nodes"}}));
  SUTURE_CHECK_SAYS(text, "have sides of 3 and 2 nodes and cannot match; choose Coupling = Mortar");
  TEST_ASSERT(!build(mesh, held, contact("joint", "upper_bottom", "lower_top")).notes.empty());
}

TEUCHOS_UNIT_TEST(MortarPairs, RefusesASideOfTwoOrders) {
  Box more;
  more.name = "more", more.x0 = 2, more.x1 = 4, more.y0 = 1, more.y1 = 2, more.nx = 4, more.ny = 2;
  Box upper, lower;
  upper.name = "upper", upper.x1 = 2, upper.y0 = 1, upper.y1 = 2, upper.nx = 4, upper.ny = 2, upper.cell = P2;
  lower.name = "lower", lower.x1 = 4, lower.nx = 8, lower.ny = 2;
  Mesh mesh = boxes({upper, more, lower});
  std::vector<int>& both = mesh.elementGroups["both"];  // one body of two pieces
  for (const char* piece : {"upper", "more"})
    both.insert(both.end(), mesh.elementGroups.at(piece).begin(), mesh.elementGroups.at(piece).end());
  std::vector<Side>& side = mesh.sideGroups["both_bottom"];
  for (const char* piece : {"upper_bottom", "more_bottom"})
    side.insert(side.end(), mesh.sideGroups.at(piece).begin(), mesh.sideGroups.at(piece).end());
  assignBodies(mesh, {"both", "lower"});
  SUTURE_CHECK_SAYS(said(mesh, held, contact("joint", "both_bottom", "lower_top")),
                    "Contact/joint/Side A: 'both_bottom' has two-node and three-node sides");
}

}  // namespace
