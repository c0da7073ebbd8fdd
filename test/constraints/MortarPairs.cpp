// Mortar pairs: what the conditions say of displacements and gaps that are known everywhere.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/Surface.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "ConstraintsTesting.hpp"

namespace {

using namespace constraintstesting;

const double pi = 3.14159265358979323846;

/// Two boxes one on the other, the upper one from x0 to x1, the lower from 0 to 4, with so many cells.
Mesh twoBoxes(double x0, double x1, int upperCells, int lowerCells, Cell upper, Cell lower) {
  Box above, below;
  above.name = "upper";
  above.x0 = x0, above.x1 = x1, above.y0 = 1, above.y1 = 2;
  above.nx = upperCells, above.ny = 2, above.cell = upper;
  below.name = "lower";
  below.x1 = 4, below.nx = lowerCells, below.ny = 2, below.cell = lower;
  Mesh mesh = boxes({above, below});
  assignBodies(mesh, {"upper", "lower"});
  return mesh;
}

std::string mortar(const std::string& carrier = "Automatic", std::vector<std::pair<std::string, std::string>> more = {}) {
  more.insert(more.end(), {{"Side A", "upper_bottom"}, {"Side B", "lower_top"}, {"Coupling", "Mortar"}, {"Multipliers On", carrier}});
  return entry("joint", more);
}

const std::string held = displacement("above", "upper_top", "{0.0, 0.0}") + displacement("below", "lower_bottom", "{0.0, 0.0}");

/// Sum over the ends of a pair that lie on a body of weight times f(place).
double sum(const Mesh& mesh, const ContactPair& pair, int body, const std::function<double(Point)>& f) {
  double all = 0;
  for (const PairEnd& end : pair.ends)
    if (mesh.bodyOfNode[end.node] == body) all += end.weight * f(mesh.point(end.node));
  return all;
}

struct Case {
  double x0, x1;
  int upperCells, lowerCells;
  Cell upper, lower;
};
const Cell P1 = Cell::Triangle3, P2 = Cell::Triangle6, Q8 = Cell::Quadrilateral8;
const Case cases[] = {{0, 4, 8, 13, P1, P1},     {0, 4, 40, 3, P1, P1},         {1, 3, 7, 11, P1, P1},        {-1, 5, 9, 5, P1, P1},
                      {-0.7, 3.3, 8, 8, P1, P1}, {0, 4, 8, 13, P2, P2},         {0, 4, 7, 5, P2, P1},         {0, 4, 5, 8, P1, Q8},
                      {-0.7, 3.3, 8, 9, P2, P2}, {-0.001, 3.999, 8, 8, P1, P1}, {-0.001, 3.999, 8, 8, P2, P2}};

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

TEUCHOS_UNIT_TEST(MortarPairs, HasTheLengthOfWhatTheSidesShare) {
  for (const Case& c : cases)
    for (const std::string carrier : {"Side A", "Side B"}) {
      const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
      double length = 0;
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) length += pair.length;
      TEST_FLOATING_EQUALITY(length, std::min(4.0, c.x1) - std::max(0.0, c.x0), 1e-12);
    }
}

// Forces of a constant pressure: each node gets what its own shape function takes in over the shared length, on either side. With the
// trapezoidal rule of the hat functions where the other side covers all of it.
TEUCHOS_UNIT_TEST(MortarPairs, PassesAConstantPressureOnToBothSides) {
  for (const Case& c : {cases[0], cases[1], cases[2], cases[5], cases[6], cases[7]}) {
    const Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    std::map<int, double> force;
    for (const ContactPair& pair : build(mesh, held, mortar("Side A")).pairs)
      for (const PairEnd& end : pair.ends) force[end.node] += end.weight * pair.length;
    const bool inside = c.x0 > 0;  // then only the upper side is covered as a whole
    for (const auto& [group, sign] : {std::make_pair("upper_bottom", 1.0), std::make_pair("lower_top", -1.0)}) {
      if (inside && sign < 0) continue;
      const Surface surface(mesh, mesh.sideGroups.at(group));
      for (const auto& [node, data] : surface.nodes()) TEST_FLOATING_EQUALITY(sign * force[node], data.tributary, 1e-11);
    }
  }
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

// Quarters of rings, 12 elements of the outer one with the radius 2 + gap, 17 of the inner one with the radius 2. Of the outer one only a
// part from one end.
Mesh twoRings(Cell outer, Cell inner, double gap, double part = 1) {
  Mesh mesh = twoBoxes(0, 4 * part, 12, 17, outer, inner);
  const auto bend = [](double inner) {
    return [=](Point p) {
      const double angle = pi / 8 * p[0], radius = inner + p[1];
      return Point{radius * std::sin(angle), radius * std::cos(angle), 0};
    };
  };
  move(mesh, 0, bend(1.0 + gap));
  move(mesh, 1, bend(1.0));
  return mesh;
}

Mesh twoRings(Cell cell, double gap) { return twoRings(cell, cell, gap); }

std::string withGeometry(const std::string& carrier, const std::string& geometry) { return mortar(carrier, {{"Geometry", geometry}}); }

double largestGapError(const Constraints& constraints, double gap) {
  double error = 0;
  for (const ContactPair& pair : constraints.pairs) error = std::max(error, std::abs(pair.gap - gap));
  return error;
}

// The gap is the difference of the radii, up to the chords' distance from their arcs.
TEUCHOS_UNIT_TEST(MortarPairs, FindsTheGapBetweenCurvedSides) {
  for (const Cell cell : {P1, P2})
    for (const std::string carrier : {"Side A", "Side B"}) {
      const Mesh mesh = twoRings(cell, 0.1);
      const Constraints constraints = build(mesh, held, mortar(carrier));
      double length = 0;
      for (const ContactPair& pair : constraints.pairs) {
        length += pair.length;
        const Point radial = unit(mesh.point(pair.node()));
        TEST_COMPARE(norm(minus(radial, {-pair.normal[0], -pair.normal[1], 0})), <, cell == P1 ? 0.1 : 0.005);
      }
      TEST_FLOATING_EQUALITY(length, carrier == "Side A" ? 1.05 * pi : pi, cell == P1 ? 1e-2 : 1e-3);  // leaning normals at the ends
      // Seen along the constant normal of a row, the gap grows with the angle to the element's other end. Two-node elements have a
      // curvature between the two.
      TEST_COMPARE(largestGapError(constraints, 0.1), <, cell == P1 ? 5e-4 : 2e-4);
    }
  const double sagitta = 2.1 * (1 - std::cos(pi / 2 / 12 / 2));
  TEST_COMPARE(largestGapError(build(twoRings(P1, 0.1), held, withGeometry("Side B", "Facets")), 0.1), >, 0.3 * sagitta);
  TEST_COMPARE(largestGapError(build(twoRings(P1, 0.1), held, withGeometry("Side B", "Smooth")), 0.1), <, 3e-4);
}

TEUCHOS_UNIT_TEST(MortarPairs, FindsThatArcsOfOneRadiusTouch) {
  for (const std::string carrier : {"Side A", "Side B"})
    for (const std::string geometry : {"Automatic", "Smooth"}) {
      const Constraints touching = build(twoRings(P1, 0), held, withGeometry(carrier, geometry));
      TEST_COMPARE(largestGapError(touching, 0), <, 2e-7);  // slopes of the arcs, to second order
      TEST_EQUALITY(touching.notes.size(), 0u);
    }
}

TEUCHOS_UNIT_TEST(MortarPairs, LeavesStraightSidesToTheLastBit) {
  for (const Case& c : cases) {
    Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    moveAll(mesh, [](Point p) {
      return Point{p[0] * std::cos(0.7) - p[1] * std::sin(0.7), p[0] * std::sin(0.7) + p[1] * std::cos(0.7), 0};
    });
    const Constraints smooth = build(mesh, held, mortar()), facets = build(mesh, held, withGeometry("Automatic", "Facets"));
    TEST_EQUALITY(smooth.pairs.size(), facets.pairs.size());
    for (std::size_t i = 0; i < smooth.pairs.size(); ++i) {
      const ContactPair &a = smooth.pairs[i], &b = facets.pairs[i];
      TEST_EQUALITY(a.gap, b.gap);
      TEST_EQUALITY(a.length, b.length);
      for (std::size_t end = 0; end < a.ends.size(); ++end) TEST_EQUALITY(a.ends[end].weight, b.ends[end].weight);
    }
  }
}

/// Moment of a pair's unit force on both bodies, over the size of the scene: ends at their places.
double momentOf(const Mesh& mesh, const ContactPair& pair) {
  double moment = 0;
  for (const PairEnd& end : pair.ends) moment += end.weight * cross(mesh.point(end.node), pair.normal)[2];
  return std::abs(moment);
}

TEUCHOS_UNIT_TEST(MortarPairs, BalancesForcesAndMomentsOfEachPair) {
  std::vector<Mesh> meshes;
  for (const Cell cell : {P1, P2})
    for (const double gap : {0.0, 0.1, -0.05}) meshes.push_back(twoRings(cell, gap));
  for (const Case& c : cases) {  // bent where the sides cover each other in part, with a gap
    Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    move(mesh, 0, [](Point p) { return Point{p[0], p[1] + 0.05 * std::pow(p[0] - 2, 2), 0}; });
    meshes.push_back(mesh);
  }
  for (const Mesh& mesh : meshes)
    for (const std::string carrier : {"Side A", "Side B"})
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) {
        TEST_COMPARE(std::abs(sum(mesh, pair, 0, [](Point) { return 1.0; }) + sum(mesh, pair, 1, [](Point) { return 1.0; })), <, 1e-12);
        TEST_COMPARE(momentOf(mesh, pair), <, 2e-11);  // ends of a weight below 1e-12 are left out
      }
}

TEUCHOS_UNIT_TEST(MortarPairs, IsCarriedByTheCoarserSideWhereLinearElementsMeetOnACurve) {
  const auto carrier = [](const Mesh& mesh) { return mesh.bodyOfNode[build(mesh, held, mortar()).pairs[0].node()]; };
  TEST_EQUALITY(carrier(twoRings(P1, 0.1)), 0);               // 12 elements against 17
  TEST_EQUALITY(carrier(twoRings(P2, 0.1)), 1);               // their sides can bend
  TEST_EQUALITY(carrier(twoBoxes(0, 4, 12, 17, P1, P1)), 1);  // straight
  TEST_EQUALITY(carrier(twoRings(P1, P2, 0.1)), 0);           // linear elements against such that bend
  TEST_EQUALITY(carrier(twoRings(P2, P1, 0.1)), 1);
  // A fine shoe that the coarse ring covers wholly.
  TEST_EQUALITY(carrier(twoRings(P1, P1, 0.1, 0.5)), 1);  // 12 elements on half of 17
}

TEUCHOS_UNIT_TEST(MortarPairs, WarnsOfAFinerSideThatIsToldToCarryOnACurve) {
  const auto warnings = [](const Mesh& mesh, const std::string& carrier) {
    int count = 0;
    for (const std::string& note : build(mesh, held, mortar(carrier)).notes) count += note.find("Multipliers On: " + carrier) < 40;
    return count;
  };
  TEST_EQUALITY(warnings(twoRings(P1, P1, 0.1, 0.5), "Side A"), 0);  // 12 elements against 8 or 9 of 17
  TEST_EQUALITY(warnings(twoRings(P1, P1, 0.1, 0.25), "Side A"), 1);
  TEST_EQUALITY(warnings(twoRings(P1, P1, 0.1, 0.25), "Side B"), 0);
  TEST_EQUALITY(warnings(twoRings(P2, P2, 0.1, 0.25), "Side A"), 0);     // their sides can bend
  TEST_EQUALITY(warnings(twoBoxes(0, 1, 12, 17, P1, P1), "Side A"), 0);  // straight
  TEST_EQUALITY(warnings(twoRings(P1, P1, 0.1, 0.25), "Automatic"), 0);
}

// At the point where a crowned side touches, the linear function nearest to the gap is below zero: no interference. Deeper than that it is
// one.
TEUCHOS_UNIT_TEST(MortarPairs, CallsTouchingCurvesNoInterference) {
  for (const std::string carrier : {"Side A", "Side B"})
    for (const double depth : {0.0, 0.2}) {
      Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
      move(mesh, 0, [&](Point p) { return Point{p[0], p[1] - depth + (2 - p[1]) * 0.05 * p[0] * p[0], 0}; });
      const Constraints crowned = build(mesh, held, mortar(carrier));
      TEST_EQUALITY(crowned.notes.size(), depth > 0 ? 1u : 0u);
      if (depth > 0 && !crowned.notes.empty()) SUTURE_CHECK_SAYS(crowned.notes[0], "drawn interference 2.0e-01");
    }
}

// Second-order sides along y = a cos(k x), nodes of both on the curve: elements are parabolas, which miss the curve's third derivative.
TEUCHOS_UNIT_TEST(MortarPairs, DoubtsParabolasWhereTheCurvatureChanges) {
  const double a = 0.05;
  for (const int cells : {32, 64}) {
    Mesh mesh = twoBoxes(0, 4, cells, cells + 5, P2, P2);
    moveAll(mesh, [&](Point p) { return Point{p[0], p[1] + a * std::cos(2 * pi * p[0]), 0}; });
    const Constraints waves = build(mesh, held, mortar("Side A"), {[](const Mesh&, int) { return 0.5; }, ""});
    // 2.4 E* times the second difference of the gaps, over h: the doubt that the true gaps, which are zero, would have given. A thirteenth
    // of it remains in pressures.
    double exact = 0;
    for (std::size_t i = 1; i + 1 < waves.pairs.size(); ++i) {
      const double h = 2.0 / cells;
      exact = std::max(exact, 2.4 / 13 * std::abs(waves.pairs[i].gap - (waves.pairs[i - 1].gap + waves.pairs[i + 1].gap) / 2) / h);
    }
    out << cells << ": " << waves.pieces[0].pressureDoubt << ", exact " << exact << "\n";
    TEST_COMPARE(waves.pieces[0].pressureDoubt, >, 0.4 * exact);
    TEST_COMPARE(waves.pieces[0].pressureDoubt, <, 2.5 * exact);
  }
}

// Estimated pressures are those of the material along the sides, whatever is behind it.
TEUCHOS_UNIT_TEST(MortarPairs, DoubtsPressuresByTheMaterialAlongTheSides) {
  const Mesh mesh = twoRings(P1, 0.1);
  std::set<int> along;
  for (const char* group : {"upper_bottom", "lower_top"})
    for (const Side& side : mesh.sideGroups.at(group)) along.insert(side.element);
  const auto doubt = [&](const std::function<double(int)>& compliance) {
    const auto here = [&](const Mesh&, int element) { return compliance(element); };
    return build(mesh, held, withGeometry("Side A", "Facets"), {here, ""}).pieces[0].pressureDoubt;
  };
  const double uniform = doubt([](int) { return 2.0; });
  TEST_COMPARE(uniform, >, 0.0);
  TEST_EQUALITY(doubt([&](int element) { return along.count(element) > 0 ? 2.0 : 1000.0; }), uniform);
  TEST_FLOATING_EQUALITY(doubt([](int) { return 1.0; }), 2 * uniform, 1e-14);
}

TEUCHOS_UNIT_TEST(MortarPairs, ReportsInterferenceAsDrawn) {
  for (const std::string carrier : {"Side A", "Side B"}) {
    const Constraints fit = build(twoRings(P1, -0.05), held, mortar(carrier));
    TEST_EQUALITY(fit.notes.size(), 1u);
    if (!fit.notes.empty()) SUTURE_CHECK_SAYS(fit.notes[0], "contact 'joint': drawn interference 5.0e-02, deepest at (");
  }
  TEST_EQUALITY(build(twoRings(P1, 0), held, mortar("Side A", {{"Initial Gap", "0"}})).notes.size(), 0u);
  const Constraints given = build(twoRings(P1, 0), held, mortar("Side A", {{"Initial Gap", "-0.01"}}));
  TEST_EQUALITY(given.notes.size(), 1u);
  if (!given.notes.empty()) SUTURE_CHECK_SAYS(given.notes[0], "given interference 1.0e-02");
  for (const Cell cell : {P1, P2})
    for (const double gap : {0.0, 0.1}) TEST_EQUALITY(build(twoRings(cell, gap), held, mortar()).notes.size(), 0u);
  // Elements that cut into each other between nodes on one arc: an effect of the facets that were asked for, no interference.
  TEST_EQUALITY(build(twoRings(P1, 0), held, withGeometry("Side A", "Facets")).notes.size(), 0u);
}

TEUCHOS_UNIT_TEST(MortarPairs, TakesTheGapOfAnExpression) {
  const Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
  // psi_j is biorthogonal, so that a linear gap has its nodal values.
  for (const ContactPair& pair : build(mesh, held, mortar("Side A", {{"Initial Gap", "0.01 * x + y - 1"}})).pairs)
    TEST_FLOATING_EQUALITY(pair.gap + 1, 0.01 * pair.position[0] + 1, 1e-12);
}

TEUCHOS_UNIT_TEST(MortarPairs, IsChosenWhereNodesDoNotMatchAndSaysSo) {
  const Mesh mesh = twoBoxes(0, 4, 8, 13, P1, P1);
  const Constraints constraints = build(mesh, held, contact("joint", "upper_bottom", "lower_top"));
  TEST_EQUALITY(constraints.pairs.size(), 14u);  // pairs of the finer side
  TEST_EQUALITY(constraints.notes.size(), 1u);
  SUTURE_CHECK_SAYS(constraints.notes[0], "contact 'joint': the nodes of its sides do not match; mortar, carried by 'lower_top'");
  // Carrying nodes have the axes of their pair, the others the mean of theirs.
  for (const ContactPair& pair : constraints.pairs)
    for (const PairEnd& end : pair.ends) {
      const NodeRule* rule = ruleAt(constraints, end.node);
      TEST_ASSERT(rule != nullptr);
      if (rule) TEST_EQUALITY(rule->axes[0][1], -1.0);
    }
}

TEUCHOS_UNIT_TEST(MortarPairs, SaysThatSidesOverlapNowhere) {
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
  SUTURE_CHECK_SAYS(text, "have sides of 3 and 2 nodes, which match nowhere; choose Coupling = Mortar");
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
                    "Contact/joint/Side A: 'both_bottom' has sides of two and of three nodes");
}

}  // namespace
