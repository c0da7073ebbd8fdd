// 3D mortar pairs: forces and gaps that are exact on flat faces, for any two meshes.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/ContactPairs.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "SpaceScenes.hpp"

using namespace pairstesting;

namespace {

const Cell all[] = {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27};

Contact mortar(Contact::Carrier carrier = Contact::Carrier::Automatic) {
  Contact contact = Contact::between("lower_top", "upper_bottom");
  contact.coupling = Contact::Coupling::Mortar;
  contact.carrier = carrier;
  return contact;
}

/// Nodal forces of a unit pressure: of all pairs, along their normals.
std::map<int, double> forces(const PairedSurface& paired) {
  std::map<int, double> force;
  for (const ContactPair& pair : paired.pairs)
    for (const PairEnd& end : pair.ends) force[end.node] += pair.length * end.weight;
  return force;
}

/// Integrals of the shape functions of a side group.
std::map<int, double> integrals(const Mesh& mesh, const std::string& group) {
  std::map<int, double> sizes;
  for (const Side& side : mesh.sideGroups.at(group)) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(mesh.point(node));
    std::vector<double> own(nodes.size(), 0.0);
    addTributarySizes(points, 3, false, own);
    for (std::size_t i = 0; i < nodes.size(); ++i) sizes[nodes[i]] += own[i];
  }
  return sizes;
}

double worstForce(const Mesh& mesh, const PairedSurface& paired) {
  const std::map<int, double> force = forces(paired);
  double worst = 0;
  for (const auto& [group, sign] : {std::make_pair("lower_top", 1.0), {"upper_bottom", -1.0}})
    for (const auto& [node, size] : integrals(mesh, group)) {
      const auto found = force.find(node);
      worst = std::max(worst, std::abs((found == force.end() ? 0.0 : found->second) - sign * size));
    }
  return worst;
}

/// Puts middle nodes into the middle of edges and sides.
void straighten(Mesh& mesh) {
  const auto put = [&](int node, const std::vector<int>& between) {
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (const int other : between) sum += mesh.coordinates[3 * other + k];
      mesh.coordinates[3 * node + k] = sum / double(between.size());
    }
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& info = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    for (std::size_t k = 0; k < info.edges.size() && info.order == 2; ++k)
      put(nodes[info.vertices + k], {nodes[info.edges[k][0]], nodes[info.edges[k][1]]});
    for (const std::vector<int>& side : info.sideNodes)
      if (side.size() == 9) put(nodes[side[8]], {nodes[side[0]], nodes[side[1]], nodes[side[2]], nodes[side[3]]});
  }
}

/// Mean place of a pair's ends on one side.
Point meanPlace(const Mesh& mesh, const ContactPair& pair, bool onA) {
  Point mean{0, 0, 0};
  for (const PairEnd& end : pair.ends)
    if ((mesh.bodyOfNode[end.node] == 0) == onA) mean = plus(mean, scaled(onA ? end.weight : -end.weight, mesh.point(end.node)));
  return mean;
}

// Bodies that move far: a load bends flat faces, which stay flat faces. The same side carries as before.
TEUCHOS_UNIT_TEST(MortarInSpace, IsCarriedByTheSameSideAfterALoad) {
  Mesh mesh = pairstesting::facing(Cell::Hexahedron8, 2, 1, Cell::Hexahedron8, 5, 4, 0.0);
  const auto carrier = [&] { return mesh.bodyOfNode[pairsOf(mesh, mortar()).pairs.front().node()]; };
  const int before = carrier();
  mesh.drawn = mesh.coordinates;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point p = mesh.point(node);
    mesh.coordinates[3 * node + 2] += 1e-4 * std::sin(3 * p[0]) * std::cos(2 * p[1]);
  }
  TEST_EQUALITY(carrier(), before);
}

// The edge of a tilted block touches a flat: it presses and slides along the normal and the plane of the flat.
TEUCHOS_UNIT_TEST(MortarInSpace, TakesTheNormalOfTheOtherFaceAtAnEdge) {
  Mesh mesh = pairstesting::facing(Cell::Hexahedron8, 7, 6, Cell::Hexahedron8, 3, 2, 0.0);
  move(mesh, 0, [](Point p) { return Point{3 * p[0] - 2, 3 * p[1] - 1.5, p[2]}; });
  const Turned tilt({0, 1, 0}, -0.3);
  move(mesh, 1, [&](Point p) { return tilt(p); });
  Contact contact = mortar();
  contact.carrier = Contact::Carrier::SideB;
  int atEdge = 0;
  for (const ContactPair& pair : pairsOf(mesh, contact).pairs) {
    if (std::abs(mesh.point(pair.node())[0]) > 1e-12) continue;
    ++atEdge;
    TEST_FLOATING_EQUALITY(std::abs(pair.normal[2]), 1.0, 1e-12);
  }
  TEST_EQUALITY(atEdge, 3);
}

// Gaps of touching sides are round-off of the coordinates wherever the scene is and however it is turned: they are zero. A drawn gap of a
// billionth of the size is not round-off.
TEUCHOS_UNIT_TEST(MortarInSpace, SidesThatTouchHaveNoGap) {
  const Turned turned({1, 2, 3}, 0.7);
  for (const Cell lower : {Cell::Hexahedron8, Cell::Hexahedron20})
    for (const double gap : {0.0, 1e-9}) {
      Mesh mesh = pairstesting::facing(lower, 3, 2, Cell::Hexahedron8, 4, 3, gap);
      moveAll(mesh, [&](const Point& p) { return turned({p[0] + 0.3, p[1] - 7.1, p[2] + 2.9}); });
      const PairedSurface paired = pairsOf(mesh, mortar());
      TEST_COMPARE(paired.pairs.size(), >, 10u);
      for (const ContactPair& pair : paired.pairs) {
        if (gap == 0.0) TEST_EQUALITY(pair.gap, 0.0);
        if (gap > 0.0) TEST_FLOATING_EQUALITY(pair.gap, gap, 1e-4);
      }
    }
}

}  // namespace

TEUCHOS_UNIT_TEST(MortarInSpace, PassesAConstantPressureOnBetweenAnyTwoMeshes) {
  for (const Cell lower : all)
    for (const Cell upper : all)
      for (const auto carrier : {Contact::Carrier::SideA, Contact::Carrier::SideB}) {
        const Mesh mesh = facing(lower, 3, 2, upper, 4, 3, 0.0);
        const PairedSurface paired = pairsOf(mesh, mortar(carrier));
        double area = 0;
        for (const ContactPair& pair : paired.pairs) {
          area += pair.length;
          TEST_ASSERT(std::abs(pair.normal[2] - 1) < 1e-14);
          TEST_COMPARE(std::abs(pair.gap), <, 1e-14);
        }
        TEST_FLOATING_EQUALITY(area, 3.0, 1e-13);
        TEST_COMPARE(worstForce(mesh, paired), <, 1e-13);
      }
}

// Conditions are means of the gap: a linear function has the same value at the mean places of both sides.
TEUCHOS_UNIT_TEST(MortarInSpace, TakesTheSameMeanOfALinearFunctionOnBothSides) {
  const auto f = [](const Point& p) { return 0.3 - 0.7 * p[0] + 1.1 * p[1]; };
  for (const Cell lower : all)
    for (const Cell upper : all) {
      const Mesh mesh = facing(lower, 3, 2, upper, 4, 3, 0.0);
      Contact contact = mortar();
      contact.initialGap = Expression([&](const Point& p) { return f(p); });
      for (const ContactPair& pair : pairsOf(mesh, contact).pairs) {
        double a = 0, b = 0, onA = 0, onB = 0;
        for (const PairEnd& end : pair.ends) {
          const bool below = mesh.bodyOfNode[end.node] == 0;
          (below ? a : b) += end.weight * f(mesh.point(end.node));
          (below ? onA : onB) += end.weight;
        }
        TEST_FLOATING_EQUALITY(onA, 1.0, 1e-12);
        TEST_FLOATING_EQUALITY(onB, -1.0, 1e-12);
        TEST_COMPARE(std::abs(a + b), <, 1e-12);
        TEST_COMPARE(std::abs(a - pair.gap), <, 1e-12);
      }
    }
}

TEUCHOS_UNIT_TEST(MortarInSpace, TurnsWithTheBodies) {
  const Turned turn({0.3, 1, 2}, 1.1);
  for (const Cell cell : all) {
    Mesh mesh = facing(cell, 3, 2, cell, 4, 3, 0.1), turned = mesh;
    const auto wave = [](Point p) -> Point {
      return {p[0] + 0.2 * p[1], p[1], p[2] + 0.03 * std::sin(2 * p[0] + 0.3) * std::cos(1.5 * p[1])};
    };
    moveAll(mesh, wave);
    moveAll(turned, [&](Point p) { return turn(wave(p)); });
    const PairedSurface before = pairsOf(mesh, mortar()), after = pairsOf(turned, mortar());
    TEST_EQUALITY(before.pairs.size(), after.pairs.size());
    for (std::size_t i = 0; i < before.pairs.size(); ++i) {
      const ContactPair &own = before.pairs[i], &its = after.pairs[i];
      TEST_COMPARE(norm(minus(turn(own.normal), its.normal)), <, 1e-12);
      TEST_COMPARE(std::abs(own.gap - its.gap), <, 1e-12);
      TEST_COMPARE(std::abs(own.length - its.length), <, 1e-12);
      std::map<int, double> difference;
      for (const PairEnd& end : own.ends) difference[end.node] += end.weight;
      for (const PairEnd& end : its.ends) difference[end.node] -= end.weight;
      for (const auto& entry : difference) TEST_COMPARE(std::abs(entry.second), <, 1e-11);
    }
    TEST_ASSERT(before.cells == after.cells);
  }
}

// The forces of a row on both sides have the same line of action: on curved faces, and across a gap.
TEUCHOS_UNIT_TEST(MortarInSpace, BalancesTheMomentsOfEachPair) {
  for (const Cell lower : all)
    for (const Cell upper : {Cell::Hexahedron8, Cell::Tetrahedron10}) {
      Mesh mesh = facing(lower, 4, 3, upper, 3, 4, 0.2);
      moveAll(mesh, [](Point p) -> Point {
        const Point ray{std::tan(0.4 * (p[0] - 1)), std::tan(0.5 * (p[1] - 0.75)), 1};
        return scaled((2 + p[2]) / norm(ray), ray);
      });
      Contact contact = mortar();
      contact.geometry = Contact::Geometry::Facets;  // otherwise the gap is that between the smooth faces
      for (const ContactPair& pair : pairsOf(mesh, contact).pairs) {
        const Point way = minus(meanPlace(mesh, pair, false), meanPlace(mesh, pair, true));
        TEST_COMPARE(norm(cross(way, pair.normal)), <, 1e-12);
        TEST_COMPARE(std::abs(dot(way, pair.normal) - pair.gap), <, 1e-12);
      }
    }
}

// The upper box is shifted: only a part is covered, across elements.
// Ends on the carrying side come first; on second-order sides single weights there have either sign.
TEUCHOS_UNIT_TEST(MortarInSpace, KnowsItsOwnEnds) {
  bool mixed = false;
  for (const Cell lower : all)
    for (const auto carrier : {Contact::Carrier::SideA, Contact::Carrier::SideB}) {
      const Mesh mesh = facing(lower, 3, 2, Cell::Hexahedron20, 4, 3, 0.0);
      for (const ContactPair& pair : pairsOf(mesh, mortar(carrier)).pairs)
        for (int i = 0; i < static_cast<int>(pair.ends.size()); ++i) {
          const PairEnd& end = pair.ends[static_cast<std::size_t>(i)];
          TEST_EQUALITY(mesh.bodyOfNode[end.node] == mesh.bodyOfNode[pair.node()], i < pair.own);
          mixed = mixed || (i < pair.own && end.weight * pair.ends.front().weight < 0.0);
        }
    }
  TEST_ASSERT(mixed);
}

TEUCHOS_UNIT_TEST(MortarInSpace, CoversThePartThatBothFacesShare) {
  for (const Cell lower : all)
    for (const Cell upper : all)
      for (const auto carrier : {Contact::Carrier::SideA, Contact::Carrier::SideB}) {
        Mesh mesh = facing(lower, 3, 2, upper, 4, 3, 0.0);
        move(mesh, 1, [](Point p) -> Point { return {p[0] + 0.61, p[1] - 0.43, p[2]}; });
        const PairedSurface paired = pairsOf(mesh, mortar(carrier));
        const double area = (2 - 0.61) * (1.5 - 0.43);
        const Point centre{(2 + 0.61) / 2, (1.5 - 0.43) / 2, 0};
        double sum = 0;
        Point momentA{0, 0, 0}, momentB{0, 0, 0}, moment{0, 0, 0};
        for (const ContactPair& pair : paired.pairs) {
          sum += pair.length;
          TEST_COMPARE(pair.length, >, 0.0);
          TEST_COMPARE(pair.position[0], >, 0.61 - 0.1 * 2.0 / 3);  // none beyond the end of the partner
          TEST_COMPARE(pair.position[1], <, 1.5 - 0.43 + 0.1 * 1.5 / 2);
          moment = plus(moment, scaled(pair.length, pair.position));
          momentA = plus(momentA, scaled(pair.length, meanPlace(mesh, pair, true)));
          momentB = plus(momentB, scaled(pair.length, meanPlace(mesh, pair, false)));
        }
        TEST_FLOATING_EQUALITY(sum, area, 1e-12);
        TEST_COMPARE(norm(minus(momentA, scaled(area, centre))), <, 1e-12);
        TEST_COMPARE(norm(minus(momentB, scaled(area, centre))), <, 1e-12);
        TEST_COMPARE(norm(minus(moment, scaled(area, centre))), <, 1e-12);
      }
}

// Sides of six and eight nodes choose the mortar automatically; all its conditions have forces in the direction of the pressure.
// A side whose covered part passes the limit between two shapes: the choices of the first shape are kept up to a band.
TEUCHOS_UNIT_TEST(MortarInSpace, KeepsItsChoicesUpToABand) {
  const auto shortened = [](double covered) {  // of the last column of the carrying side
    Mesh mesh = facing(Cell::Hexahedron20, 2, 1, Cell::Hexahedron20, 3, 2, 0.0);
    move(mesh, 1, [&](const Point& p) { return Point{p[0] * (1 + covered) / 2, p[1], p[2]}; });
    return mesh;
  };
  const auto pairsAfter = [&](const std::vector<double>& covered) {
    MortarChoices choices;
    std::size_t last = 0;
    for (const double part : covered) {
      const Mesh mesh = shortened(part);
      Problems problems;
      std::vector<std::string> notes;
      std::vector<ContactSurface> contacts = contactsOn(mesh, {mortar(Contact::Carrier::SideA)}, problems);
      contacts[0].choices = &choices;
      last = pairSurface(mesh, contacts[0], problems, notes).pairs.size();
    }
    return last;
  };
  const std::size_t whole = pairsAfter({1.0}), parted = pairsAfter({0.93});
  TEST_COMPARE(whole, >, parted);
  TEST_EQUALITY(pairsAfter({0.96}), whole);
  TEST_EQUALITY(pairsAfter({1.0, 0.96}), whole);
  TEST_EQUALITY(pairsAfter({0.93, 0.96}), parted);
  TEST_EQUALITY(pairsAfter({0.93, 0.96, 0.98}), whole);
  TEST_EQUALITY(pairsAfter({0.93, 0.98, 0.96}), whole);
  TEST_EQUALITY(pairsAfter({1.0, 0.93}), parted);
}

// The normal at an edge is that of both faces if the other face ends there, and a strain before or after it: here a bent face on a flat
// one, whose normals differ.
TEUCHOS_UNIT_TEST(MortarInSpace, HasTheSameNormalsIfTheOtherSideEndsAStrainEarlier) {
  const double strain = 1e-4;
  for (const Cell cell : all) {
    std::vector<std::map<int, Point>> normals;
    for (const double change : {0.0, strain, -strain}) {
      Mesh mesh = facing(cell, 3, 2, cell, 4, 3, 0.0);
      move(mesh, 0, [&](const Point& p) { return Point{p[0], p[1], p[2] - 0.05 * p[0] * p[0]}; });
      move(mesh, 1, [&](const Point& p) { return Point{(1 - change) * (p[0] - 1) + 1, (1 - change) * (p[1] - 0.75) + 0.75, p[2]}; });
      Contact contact = mortar(Contact::Carrier::SideA);
      std::map<int, Point>& all = normals.emplace_back();
      for (const ContactPair& pair : pairsOf(mesh, contact).pairs) all[pair.node()] = pair.normal;
    }
    double most = 0;
    for (std::size_t i = 1; i < normals.size(); ++i) {
      TEST_EQUALITY(normals[i].size(), normals[0].size());
      for (const auto& [node, normal] : normals[0])
        if (normals[i].count(node)) most = std::max(most, norm(minus(normals[i].at(node), normal)));
    }
    TEST_COMPARE(most, <, 5 * strain);
  }
}

// Sides that end together as drawn: a load makes one of them longer, by far less than an element. The pairs and their forces change by as
// little.
TEUCHOS_UNIT_TEST(MortarInSpace, HardlyChangesIfTheOtherSideEndsAStrainEarlier) {
  const double strain = 1e-4;
  for (const Cell cell : all) {
    Mesh mesh = facing(cell, 3, 2, cell, 4, 3, 0.0);
    const PairedSurface before = pairsOf(mesh, mortar(Contact::Carrier::SideA));
    const std::map<int, double> drawn = forces(before);
    move(mesh, 1, [&](const Point& p) { return Point{(1 - strain) * p[0], (1 - strain) * p[1], p[2]}; });
    const PairedSurface after = pairsOf(mesh, mortar(Contact::Carrier::SideA));
    TEST_EQUALITY(after.pairs.size(), before.pairs.size());
    const std::map<int, double> strained = forces(after);
    double largest = 0, change = 0;
    for (const auto& [node, force] : drawn) {
      const auto now = strained.find(node);
      largest = std::max(largest, std::abs(force));
      change = std::max(change, std::abs(force - (now == strained.end() ? 0.0 : now->second)));
    }
    TEST_COMPARE(change, <, 20 * strain * largest);
  }
}

TEUCHOS_UNIT_TEST(MortarInSpace, IsChosenWhereNodesCannotCarryThePressure) {
  for (const Cell cell : all) {
    const bool second = cell == Cell::Tetrahedron10 || cell == Cell::Hexahedron20;
    const Mesh mesh = facing(cell, 3, 2, cell, 3, 2, 0.0);
    std::vector<std::string> notes;
    const PairedSurface paired = pairsOf(mesh, Contact::between("lower_top", "upper_bottom"), &notes);
    TEST_EQUALITY(notes.size(), std::size_t(second));
    TEST_EQUALITY(paired.pairs.size(), integrals(mesh, "lower_top").size());
    if (second) {
      TEST_EQUALITY(paired.cells.size(), std::size_t(cell == Cell::Tetrahedron10 ? 12 * 4 : 6 * 5));
      TEST_ASSERT(notes[0].find("a pressure on six- or eight-node sides exerts no force at their vertices; mortar") != std::string::npos);
    }
    for (const ContactPair& pair : paired.pairs) {
      TEST_COMPARE(pair.ends.front().weight, >, 0.0);
      TEST_COMPARE(pair.length, >, 0.0);
    }
    TEST_COMPARE(worstForce(mesh, paired), <, 1e-13);
  }
}

// The condition of a vertex has one node of the carrying face; that of a middle node also has the two adjacent vertices: in this order each
// can be solved for its node.
TEUCHOS_UNIT_TEST(MortarInSpace, HasConditionsThatCanBeSolvedOneAfterTheOther) {
  for (const Cell cell : all) {
    const Mesh mesh = facing(cell, 3, 2, Cell::Hexahedron8, 4, 3, 0.0);
    const PairedSurface paired = pairsOf(mesh, mortar(Contact::Carrier::SideA));
    const bool transformed = cell == Cell::Tetrahedron10 || cell == Cell::Hexahedron20;
    std::set<int> vertices;
    for (const Side& side : mesh.sideGroups.at("lower_top")) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      vertices.insert(nodes.begin(), nodes.begin() + sideVertices(int(nodes.size()), 3));
    }
    for (const ContactPair& pair : paired.pairs) {
      std::vector<int> own;
      for (const PairEnd& end : pair.ends)
        if (mesh.bodyOfNode[end.node] == 0) own.push_back(end.node);
      TEST_EQUALITY(own.front(), pair.node());
      const bool middle = vertices.count(pair.node()) == 0;
      TEST_EQUALITY(own.size(), std::size_t(transformed && middle ? 3 : 1));
      for (std::size_t k = 1; k < own.size(); ++k) TEST_ASSERT(vertices.count(own[k]) > 0);
      TEST_FLOATING_EQUALITY(pair.ends.front().weight, transformed && middle ? 5.0 / 3 : 1.0, 1e-11);
    }
  }
}

// If the scene chooses it, second-order sides carry linear functions, one per vertex.
TEUCHOS_UNIT_TEST(MortarInSpace, PassesAConstantPressureWithLinearMultipliers) {
  for (const Cell lower : {Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27})
    for (const Cell upper : all) {
      const Mesh mesh = facing(lower, 3, 2, upper, 4, 3, 0.0);
      Contact contact = mortar(Contact::Carrier::SideA);
      contact.multipliers = Contact::Multipliers::Linear;
      const PairedSurface paired = pairsOf(mesh, contact);
      TEST_EQUALITY(paired.pairs.size(), std::size_t(4 * 3));
      TEST_EQUALITY(paired.cells.size(), std::size_t(lower == Cell::Tetrahedron10 ? 12 : 6));
      double area = 0;
      for (const ContactPair& pair : paired.pairs) {
        TEST_COMPARE(pair.length, >, 0.0);
        TEST_COMPARE(pair.ends.front().weight, >, 0.0);
        area += pair.length;
      }
      TEST_FLOATING_EQUALITY(area, 3.0, 1e-13);
      TEST_COMPARE(worstForce(mesh, paired), <, 1e-13);
    }
}

// Matching first-order meshes: a mortar row has one node on each side, like matching nodes.
TEUCHOS_UNIT_TEST(MortarInSpace, IsNodeToNodeOnMatchingMeshes) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4}) {
    const Mesh mesh = facing(cell, 3, 2, cell, 3, 2, 0.0);
    const PairedSurface paired = pairsOf(mesh, mortar());
    for (const ContactPair& pair : paired.pairs) {
      TEST_EQUALITY(pair.ends.size(), std::size_t(2));
      TEST_COMPARE(norm(minus(mesh.point(pair.ends[0].node), mesh.point(pair.ends[1].node))), <, 1e-14);
      TEST_FLOATING_EQUALITY(pair.ends[0].weight, 1.0, 1e-12);
    }
  }
}

// Element-wise quadrature has an error of 1e-3 here; quadrilaterals of any shape are integrated to 1e-8.
TEUCHOS_UNIT_TEST(MortarInSpace, IntegratesDistortedSidesClosely) {
  const Cell pairs[][2] = {
      {Cell::Hexahedron8, Cell::Hexahedron8}, {Cell::Hexahedron20, Cell::Tetrahedron10}, {Cell::Hexahedron27, Cell::Hexahedron8}};
  for (const auto& cells : pairs) {
    Mesh mesh = facing(cells[0], 3, 3, cells[1], 4, 3, 0.0);
    moveAll(mesh, [](Point p) -> Point {
      const double bump = p[0] * (2 - p[0]) * p[1] * (1.5 - p[1]);
      return {p[0] + 0.3 * bump * (p[2] < -1e-9 || p[2] > 1e-9 ? 1 : std::sin(3 * p[1])), p[1] - 0.25 * bump * std::sin(2 * p[0]), p[2]};
    });
    straighten(mesh);
    TEST_COMPARE(worstForce(mesh, pairsOf(mesh, mortar())), <, 1e-7);
  }
}

// Caps of one sphere: the remaining gap is the geometry error of the elements, of their order.
TEUCHOS_UNIT_TEST(MortarInSpace, FindsTheGapOfCurvedFacesToTheOrderOfTheElements) {
  const auto mean = [](Cell cell, int n) {
    Mesh mesh = facing(cell, 3 * n, 2 * n, cell, 2 * n, 3 * n, 0.0);
    moveAll(mesh, [](Point p) -> Point {
      const Point ray{std::tan(0.4 * (p[0] - 1)), std::tan(0.5 * (p[1] - 0.75)), 1};
      return scaled((2 + p[2]) / norm(ray), ray);
    });
    double square = 0, area = 0;
    for (const ContactPair& pair : pairsOf(mesh, mortar()).pairs) square += pair.length * pair.gap * pair.gap, area += pair.length;
    return std::sqrt(square / area);
  };
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4}) {
    const double coarse = mean(cell, 2), fine = mean(cell, 4);
    TEST_COMPARE(coarse, <, 0.01);
    TEST_COMPARE(fine, <, coarse / 3.5);
  }
  for (const Cell cell : {Cell::Hexahedron27, Cell::Hexahedron20, Cell::Tetrahedron10}) {
    const double coarse = mean(cell, 1), fine = mean(cell, 2);
    TEST_COMPARE(coarse, <, 1e-3);
    TEST_COMPARE(fine, <, coarse / 5.5);
  }
}

TEUCHOS_UNIT_TEST(MortarInSpace, ReportsFacesThatMeetNowhere) {
  Mesh mesh = pairstesting::facing(Cell::Hexahedron8, 2, 2, Cell::Hexahedron8, 3, 3, 0.0);
  move(mesh, 1, [](Point p) -> Point { return {p[0] + 5, p[1], p[2]}; });
  TEST_THROW(pairsOf(mesh, mortar()), InputError);
}

// The other face has two sheets, one behind the other: the nearer counts.
TEUCHOS_UNIT_TEST(MortarInSpace, TakesTheNearerOfTwoSheets) {
  std::vector<Box> boxesOfAll(3);
  const char* names[] = {"lower", "upper", "far"};
  for (int k = 0; k < 3; ++k) {
    Box& box = boxesOfAll[k];
    box.name = names[k];
    box.nx = 2 + k, box.ny = 3 - k, box.nz = 1, box.cell = Cell::Hexahedron8;
    box.z0 = k, box.z1 = k + 0.9;
  }
  Mesh mesh = boxes(boxesOfAll);
  assignBodies(mesh, {"lower", "upper", "far"});
  Contact contact = mortar();
  contact.groupsB = {"upper_bottom", "far_bottom"};
  contact.carrier = Contact::Carrier::SideA;
  double area = 0;
  for (const ContactPair& pair : pairsOf(mesh, contact).pairs) {
    area += pair.length;
    TEST_FLOATING_EQUALITY(pair.gap, 0.1, 1e-12);
  }
  TEST_FLOATING_EQUALITY(area, 1.0, 1e-12);
}

// Faces on both ends of both boxes: only those between the boxes meet, since everything behind a box is at its far end.
TEUCHOS_UNIT_TEST(MortarInSpace, DoesNotPairFarEndsThroughTheBodies) {
  for (const double gap : {0.125, 0.0, -0.125})
    for (const Contact::Carrier carrier : {Contact::Carrier::SideA, Contact::Carrier::SideB})
      for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron10}) {
        const Mesh mesh = facing(cell, 3, 2, Cell::Hexahedron8, 4, 3, gap);
        Contact contact = mortar(carrier);
        const PairedSurface expected = pairsOf(mesh, contact);
        contact.groupsA = {"lower_bottom", "lower_top"}, contact.groupsB = {"upper_bottom", "upper_top"};
        const PairedSurface found = pairsOf(mesh, contact);
        TEST_EQUALITY(found.pairs.size(), expected.pairs.size());
        for (const ContactPair& pair : found.pairs) TEST_FLOATING_EQUALITY(pair.gap + 1.0, gap + 1.0, 1e-13);
      }
}
