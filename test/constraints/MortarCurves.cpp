// Mortar pairs on curves: gaps, forces and moments, uncertainties, interference.
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

// Quarters of rings, 12 elements of the outer one with the radius 2 + gap, 17 of the inner one with the radius 2. The outer one may be cut
// to a part from one end.
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

// The gap is the difference of the radii, up to the distance of the chords from their arcs.
TEUCHOS_UNIT_TEST(MortarCurves, FindsTheGapBetweenCurvedSides) {
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
      TEST_FLOATING_EQUALITY(length, carrier == "Side A" ? 1.05 * pi : pi, cell == P1 ? 1e-2 : 1e-3);  // inclined normals at the ends
      // Along the constant normal of a row, the gap grows with the angle to the element's other end. Two-node elements have a curvature
      // between the two.
      TEST_COMPARE(largestGapError(constraints, 0.1), <, cell == P1 ? 5e-4 : 2e-4);
    }
  const double sagitta = 2.1 * (1 - std::cos(pi / 2 / 12 / 2));
  TEST_COMPARE(largestGapError(build(twoRings(P1, 0.1), held, withGeometry("Side B", "Facets")), 0.1), >, 0.3 * sagitta);
  TEST_COMPARE(largestGapError(build(twoRings(P1, 0.1), held, withGeometry("Side B", "Smooth")), 0.1), <, 3e-4);
}

TEUCHOS_UNIT_TEST(MortarCurves, FindsThatArcsOfOneRadiusTouch) {
  for (const std::string carrier : {"Side A", "Side B"})
    for (const std::string geometry : {"Automatic", "Smooth"}) {
      const Constraints touching = build(twoRings(P1, 0), held, withGeometry(carrier, geometry));
      TEST_COMPARE(largestGapError(touching, 0), <, 2e-7);  // slopes of the arcs, to second order
      TEST_EQUALITY(touching.notes.size(), 0u);
    }
}

TEUCHOS_UNIT_TEST(MortarCurves, LeavesStraightSidesToTheLastBit) {
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

/// Moment of a pair's unit force on both bodies, divided by the size of the scene: ends at their places.
double momentOf(const Mesh& mesh, const ContactPair& pair) {
  double moment = 0;
  for (const PairEnd& end : pair.ends) moment += end.weight * cross(mesh.point(end.node), pair.normal)[2];
  return std::abs(moment);
}

TEUCHOS_UNIT_TEST(MortarCurves, BalancesForcesAndMomentsOfEachPair) {
  std::vector<Mesh> meshes;
  for (const Cell cell : {P1, P2})
    for (const double gap : {0.0, 0.1, -0.05}) meshes.push_back(twoRings(cell, gap));
  for (const Case& c : cases) {  // curved where the sides overlap partly, with a gap
    Mesh mesh = twoBoxes(c.x0, c.x1, c.upperCells, c.lowerCells, c.upper, c.lower);
    move(mesh, 0, [](Point p) { return Point{p[0], p[1] + 0.05 * std::pow(p[0] - 2, 2), 0}; });
    meshes.push_back(mesh);
  }
  for (const Mesh& mesh : meshes)
    for (const std::string carrier : {"Side A", "Side B"})
      for (const ContactPair& pair : build(mesh, held, mortar(carrier)).pairs) {
        TEST_COMPARE(std::abs(sum(mesh, pair, 0, [](Point) { return 1.0; }) + sum(mesh, pair, 1, [](Point) { return 1.0; })), <, 1e-12);
        TEST_COMPARE(momentOf(mesh, pair), <, 2e-11);  // ends with a weight below 1e-12 are left out
      }
}

TEUCHOS_UNIT_TEST(MortarCurves, IsCarriedByTheCoarserSideWhereLinearElementsMeetOnACurve) {
  const auto carrier = [](const Mesh& mesh) { return mesh.bodyOfNode[build(mesh, held, mortar()).pairs[0].node()]; };
  TEST_EQUALITY(carrier(twoRings(P1, 0.1)), 0);               // 12 elements against 17
  TEST_EQUALITY(carrier(twoRings(P2, 0.1)), 1);               // their sides can bend
  TEST_EQUALITY(carrier(twoBoxes(0, 4, 12, 17, P1, P1)), 1);  // straight
  TEST_EQUALITY(carrier(twoRings(P1, P2, 0.1)), 0);           // linear elements against elements that bend
  TEST_EQUALITY(carrier(twoRings(P2, P1, 0.1)), 1);
  // A fine shoe covered completely by the coarse ring: the pressure ends with the shoe, unless the shoe is much finer.
  TEST_EQUALITY(carrier(twoRings(P1, P1, 0.1, 0.5)), 0);   // 12 elements on half of 17
  TEST_EQUALITY(carrier(twoRings(P1, P1, 0.1, 0.25)), 1);  // on a quarter
}

TEUCHOS_UNIT_TEST(MortarCurves, WarnsOfAFinerSideChosenToCarryOnACurve) {
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

// At the point where a crowned side touches, the linear function nearest to the gap is below zero: no interference. A deeper overlap is
// one.
TEUCHOS_UNIT_TEST(MortarCurves, CallsTouchingCurvesNoInterference) {
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
TEUCHOS_UNIT_TEST(MortarCurves, DoubtsParabolasWhereTheCurvatureChanges) {
  const double a = 0.05;
  for (const int cells : {32, 64}) {
    Mesh mesh = twoBoxes(0, 4, cells, cells + 5, P2, P2);
    moveAll(mesh, [&](Point p) { return Point{p[0], p[1] + a * std::cos(2 * pi * p[0]), 0}; });
    const Constraints waves = build(mesh, held, mortar("Side A"), {[](const Mesh&, int) { return 0.5; }, ""});
    // 2.4 E* times the second difference of the gaps, over h: the uncertainty that the true gaps, which are zero, would have given. A
    // thirteenth of it remains in pressures.
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

// Estimated pressures use the material along the sides, independent of the material behind it.
TEUCHOS_UNIT_TEST(MortarCurves, DoubtsPressuresByTheMaterialAlongTheSides) {
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

TEUCHOS_UNIT_TEST(MortarCurves, ReportsInterferenceAsDrawn) {
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
  // Elements on one arc that overlap between nodes: an effect of the facets, which the scene requested, no interference.
  TEST_EQUALITY(build(twoRings(P1, 0), held, withGeometry("Side A", "Facets")).notes.size(), 0u);
}

}  // namespace
