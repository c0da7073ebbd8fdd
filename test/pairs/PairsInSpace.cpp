// 3D contact faces and matching pairs, against numbers computed by hand and against rotated meshes.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/ContactPairs.hpp>

#include <algorithm>
#include <set>

#include "SpaceScenes.hpp"

using namespace pairstesting;

namespace {

std::string saidOf(const Mesh& mesh, const Contact& contact) {
  Problems problems;
  std::vector<std::string> notes;
  for (const ContactSurface& surface : contactsOn(mesh, {contact}, problems)) pairSurface(mesh, surface, problems, notes);
  std::string all;
  for (const auto& [path, what] : problems.list()) all += path + ": " + what + "\n";
  return all;
}

Contact matching() {
  Contact contact = Contact::between("lower_top", "upper_bottom");
  contact.coupling = Contact::Coupling::MatchingNodes;
  return contact;
}

}  // namespace

TEUCHOS_UNIT_TEST(PairsInSpace, MeasureGapNormalAndAreaOfFacingBoxes) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27}) {
    const int n = 3, m = 2, order = cellInfo(cell).order;
    const Mesh mesh = facing(cell, n, m, cell, n, m, 0.125);
    const PairedSurface paired = pairsOf(mesh, matching());
    TEST_EQUALITY(paired.pairs.size(), std::size_t((order * n + 1) * (order * m + 1)));
    double area = 0;
    for (const ContactPair& pair : paired.pairs) {
      TEST_EQUALITY(pair.ends.size(), std::size_t(2));
      TEST_EQUALITY(pair.ends[0].weight, 1.0);
      TEST_EQUALITY(pair.ends[1].weight, -1.0);
      const Point a = mesh.point(pair.ends[0].node), b = mesh.point(pair.ends[1].node);
      TEST_COMPARE(norm(minus(b, a)) - 0.125, <, 1e-14);
      TEST_ASSERT((pair.normal == Point{0, 0, 1}));
      TEST_FLOATING_EQUALITY(pair.gap, 0.125, 1e-13);
      TEST_COMPARE(pair.length, >, 0.0);
      area += pair.length;
      if (cell == Cell::Tetrahedron4) continue;
      // Trapezoidal and Simpson's rule in both directions: the integrals of products of shape functions on lines.
      double expected = 1;
      for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 2.0 / n : 1.5 / m, at = a[k] / h, part = at - std::floor(at + 1e-9);
        const bool rim = std::abs(at) < 1e-9 || std::abs(at - (k == 0 ? n : m)) < 1e-9;
        expected *= h * (order == 1 ? 1.0 : std::abs(part - 0.5) < 1e-9 ? 2.0 / 3 : 1.0 / 3) * (rim ? 0.5 : 1.0);
      }
      TEST_FLOATING_EQUALITY(pair.length, expected, 1e-13);
    }
    TEST_FLOATING_EQUALITY(area, 2.0 * 1.5, 1e-13);
    const std::size_t cells = n * m * (cell == Cell::Tetrahedron4 ? 2 : order * order), corners = cell == Cell::Tetrahedron4 ? 3 : 4;
    TEST_EQUALITY(paired.cells.size(), cells);
    for (const std::vector<int>& own : paired.cells) {
      TEST_EQUALITY(own.size(), corners);
      // Seen from outside side A they are counter-clockwise.
      const Point turn = cross(minus(paired.pairs[own[1]].position, paired.pairs[own[0]].position),
                               minus(paired.pairs[own[2]].position, paired.pairs[own[0]].position));
      TEST_COMPARE(turn[2], >, 0.0);
    }
  }
}

TEUCHOS_UNIT_TEST(PairsInSpace, CoverSidesOfWhichSomeMiddleNodesHaveNoPair) {
  for (const Cell cell : {Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27}) {
    const Mesh mesh = facing(cell, 3, 2, cell, 3, 2, 0.0);
    const Surface surface(mesh, mesh.sideGroups.at("lower_top"));
    std::set<int> vertices;
    for (int side = 0; side < surface.sides(); ++side)
      for (int v = 0; v < surface.facets(side); ++v) vertices.insert(surface.nodesOf(side)[v]);
    for (unsigned every = 1; every < 5; ++every) {  // all other nodes, every second, third, fourth
      std::vector<ContactPair> pairs;
      unsigned others = 0;
      for (const auto& [node, own] : surface.nodes()) {
        if (!vertices.count(node) && others++ % every != 0) continue;
        ContactPair pair;
        pair.id = static_cast<int>(pairs.size());
        pair.position = own.position;
        pair.ends = matchingEnds(node, node);
        pairs.push_back(pair);
      }
      double area = 0;
      std::set<int> covered;
      for (const std::vector<int>& own : cellsOf(surface, pairs)) {
        for (std::size_t k = 2; k < own.size(); ++k) {
          const Point& a = pairs[own[0]].position;
          const Point turn = cross(minus(pairs[own[k - 1]].position, a), minus(pairs[own[k]].position, a));
          TEST_COMPARE(turn[2], >, 1e-3);
          area += turn[2] / 2;
        }
        covered.insert(own.begin(), own.end());
      }
      TEST_FLOATING_EQUALITY(area, 2.0 * 1.5, 1e-13);
      TEST_EQUALITY(covered.size(), pairs.size());
    }
  }
}

TEUCHOS_UNIT_TEST(PairsInSpace, TurnWithTheBodies) {
  const Turned turn({1, 2, -0.5}, 0.9);
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27}) {
    Mesh mesh = facing(cell, 3, 2, cell, 3, 2, 0.125), turned = mesh;
    // Waves on both faces: the gap varies, and the normals turn.
    const auto wave = [](Point p) -> Point { return {p[0], p[1], p[2] + 0.03 * std::sin(2 * p[0] + 0.3) * std::cos(1.5 * p[1])}; };
    moveAll(mesh, wave);
    moveAll(turned, [&](Point p) { return turn(wave(p)); });
    Contact contact = matching();
    contact.tolerance = 0.1;  // partners are above each other, and not along their normals
    const PairedSurface before = pairsOf(mesh, contact), after = pairsOf(turned, contact);
    TEST_EQUALITY(before.pairs.size(), after.pairs.size());
    for (std::size_t i = 0; i < before.pairs.size(); ++i) {
      const ContactPair &own = before.pairs[i], &its = after.pairs[i];
      TEST_EQUALITY(own.node(), its.node());
      TEST_COMPARE(norm(minus(turn(own.normal), its.normal)), <, 1e-13);
      TEST_COMPARE(norm(minus(turn(own.position), its.position)), <, 1e-13);
      TEST_COMPARE(std::abs(own.gap - its.gap), <, 1e-13);
      TEST_COMPARE(std::abs(own.length - its.length), <, 1e-13);
    }
    TEST_ASSERT(before.cells == after.cells);
  }
}

// Concentric caps: partners lie on one ray for any gap.
TEUCHOS_UNIT_TEST(PairsInSpace, PairSpheresAlongTheirRays) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27}) {
    Mesh mesh = facing(cell, 4, 4, cell, 4, 4, 0.25);
    moveAll(mesh, [](Point p) -> Point {
      const double r = 2 + p[2];
      const Point ray{std::tan(0.4 * (p[0] - 1)), std::tan(0.5 * (p[1] - 0.75)), 1};
      return scaled(r / norm(ray), ray);
    });
    const PairedSurface paired = pairsOf(mesh, matching());
    TEST_ASSERT(!paired.pairs.empty());
    for (const ContactPair& pair : paired.pairs) {
      TEST_FLOATING_EQUALITY(pair.gap, 0.25, 1e-12);
      TEST_COMPARE(norm(cross(pair.normal, pair.position)), <, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(PairsInSpace, ReportFacesWhoseNodesDoNotMatch) {
  const std::string text = saidOf(facing(Cell::Hexahedron8, 3, 2, Cell::Hexahedron8, 4, 2, 0.0), matching());
  SUTURE_CHECK_SAYS(text, "the sides do not match: 'lower_top' has 12 nodes, 'upper_bottom' has 15 nodes; 6 and 9 of them have no partner");
  SUTURE_CHECK_SAYS(text, "along the surface = ");
  Mesh averted = facing(Cell::Hexahedron8, 3, 2, Cell::Hexahedron8, 3, 2, 0.0);
  Contact wrong = Contact::between("lower_top", "upper_top");
  wrong.coupling = Contact::Coupling::MatchingNodes;
  TEST_ASSERT(!saidOf(averted, wrong).empty());
  SUTURE_CHECK_SAYS(saidOf(facing(Cell::Hexahedron8, 3, 2, Cell::Hexahedron27, 3, 2, 0.0), matching()), "have sides of 4 and 9 nodes");
}

// The integrals of the shape functions at the vertices of six- and eight-node sides are not positive.
TEUCHOS_UNIT_TEST(PairsInSpace, RefuseNodesThatCarryNoPressure) {
  for (const Cell cell : {Cell::Tetrahedron10, Cell::Hexahedron20})
    SUTURE_CHECK_SAYS(
        saidOf(facing(cell, 3, 2, cell, 3, 2, 0.0), matching()),
        "a pressure on 'lower_top', which has six- or eight-node sides, exerts no force or an opposite force at the vertices");
}

TEUCHOS_UNIT_TEST(PairsInSpace, RequireSurfacesWithoutSharpEdges) {
  Mesh mesh = facing(Cell::Hexahedron8, 3, 2, Cell::Hexahedron8, 3, 2, 0.0);
  Contact contact = matching();
  contact.groupsA = {"lower_top", "lower_left"};
  SUTURE_CHECK_SAYS(saidOf(mesh, contact), "'lower_top' + 'lower_left' turns by 90 degrees at (0, ");
  SUTURE_CHECK_SAYS(saidOf(mesh, contact), "Make each face a separate contact");
  contact.groupsA = {"lower_topp"};
  SUTURE_CHECK_SAYS(saidOf(mesh, contact), "no such surface group 'lower_topp'. Did you mean 'lower_top'?");
  contact.groupsA = {};
  SUTURE_CHECK_SAYS(saidOf(mesh, contact), "is empty; expected a surface group, or several as {left, right}");
  // Sides of first and of second order in one face.
  Mesh orders = facing(Cell::Hexahedron8, 3, 2, Cell::Hexahedron27, 3, 2, 0.5);
  Contact both = matching();
  both.groupsA = {"lower_right", "upper_right"}, both.groupsB = {"lower_left"};
  SUTURE_CHECK_SAYS(saidOf(orders, both), "'lower_right' + 'upper_right' has first-order and second-order sides");
  // Two of four cubes around an edge, one body: four of its sides meet there.
  Mesh chess;
  chess.dimension = 3;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) chess.coordinates.insert(chess.coordinates.end(), {double(i), double(j), double(k)});
  const auto node = [](int i, int j, int k) { return i + 3 * (j + 3 * k); };
  for (const int c : {0, 1}) {
    for (const int k : {0, 1})
      for (const auto& [i, j] : {std::make_pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) chess.connectivity.push_back(node(c + i, c + j, k));
    chess.offsets.push_back(int(chess.connectivity.size()));
    chess.cells.push_back(Cell::Hexahedron8);
    for (int side = 0; side < 6; ++side) chess.sideGroups["all"].push_back({c, side});
  }
  chess.bodies = {"chess"}, chess.bodyOfElement = {0, 0}, chess.bodyOfNode.assign(18, 0);
  Contact branched = Contact::with(Obstacle::line({0, 0, 0}, {0, 1, 0}), "all");
  SUTURE_CHECK_SAYS(saidOf(chess, branched), "'all' is not a surface: more than two of its sides meet along the edge at (1, 1, 0)");
}
