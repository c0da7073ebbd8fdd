#include <Teuchos_UnitTestHarness.hpp>

#include <set>

#include <adapt/AdaptTesting.hpp>

using namespace suture;
using namespace adapttesting;

namespace {

/// Two bodies in contact at height 1, with groups, bricks and named subdomains; an irregular mesh.
Mesh stacked(Cell cell, int n) {
  std::vector<Box> all{box("lower", cell, n), box("upper", cell, n, 1, 2)};
  for (Box& each : all) each.brickX = each.brickY = each.brickZ = 1, each.blocksX = n;
  Mesh mesh = boxes(all);
  move(mesh, waved);
  straightenEdges(mesh);
  return mesh;
}

/// True if the nodes of both faces of the contact lie at the same places.
bool facesCoincide(const Mesh& mesh) {
  const auto places = [&](const char* group) {
    std::vector<std::array<long long, 3>> found;
    for (const Side& side : mesh.sideGroups.at(group))
      for (const int node : mesh.nodesOf(side)) {
        const Point p = mesh.point(node);
        found.push_back({std::llround(p[0] * 1e9), std::llround(p[1] * 1e9), std::llround(p[2] * 1e9)});
      }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  };
  return places("lower_top") == places("upper_bottom");
}

void checkLevel(const RefinableMesh& level, const Mesh& start, Teuchos::FancyOStream& out, bool& success) {
  Mesh mesh = level.mesh;
  assignBodies(mesh, start.bodies);  // throws for inverted elements, shared nodes, orphans
  TEST_ASSERT(mesh.bodyOfElement == level.mesh.bodyOfElement);
  TEST_ASSERT(mesh.bodyOfNode == level.mesh.bodyOfNode);
  for (int body = 0; body < 2; ++body) TEST_FLOATING_EQUALITY(sizeOfBody(mesh, body), sizeOfBody(start, body), 1e-13);
  TEST_FLOATING_EQUALITY(sizeOfOutline(mesh), sizeOfOutline(start), 1e-12);
  for (const auto& [name, sides] : start.sideGroups) TEST_FLOATING_EQUALITY(sizeOfGroup(mesh, name), sizeOfGroup(start, name), 1e-12);
  for (const auto& [name, members] : start.elementGroups) {
    double sum = 0, before = 0;
    for (const int e : mesh.elementGroups.at(name)) sum += sizeOf(mesh, e);
    for (const int e : members) before += sizeOf(start, e);
    TEST_FLOATING_EQUALITY(sum, before, 1e-12);
  }
}

/// Parts lie inside their parents and fill them.
void checkParents(const Refinement& next, const Mesh& coarse, Teuchos::FancyOStream& out, bool& success) {
  const Mesh& mesh = next.fine.mesh;
  std::vector<double> filled(coarse.elements(), 0);
  TEST_EQUALITY(static_cast<int>(next.parent.size()), mesh.elements());
  TEST_ASSERT(std::is_sorted(next.parent.begin(), next.parent.end()));
  int outside = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const int parent = next.parent[e];
    filled[parent] += sizeOf(mesh, e);
    const Point c = centreOf(mesh, e);
    const Span<const int> n = coarse.nodesOf(parent);
    for (int k = 0; k <= coarse.dimension; ++k) {  // barycentric coordinates: each vertex replaced by the centre
      std::vector<Point> p;
      for (int i = 0; i <= coarse.dimension; ++i) p.push_back(i == k ? c : coarse.point(n[i]));
      const Point u = minus(p[1], p[0]), v = minus(p[2], p[0]);
      if ((coarse.dimension == 2 ? cross(u, v)[2] : dot(cross(u, v), minus(p[3], p[0]))) <= 0) ++outside;
    }
  }
  TEST_EQUALITY(outside, 0);
  double worst = 0;  // relative to the round-off of coordinates of size one
  for (int e = 0; e < coarse.elements(); ++e)
    worst = std::max(worst, std::abs(filled[e] - sizeOf(coarse, e)) / std::pow(diameterOf(coarse, e), coarse.dimension - 1));
  TEST_COMPARE(worst, <, 1e-14);
}

const std::vector<Cell> cells{Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4, Cell::Tetrahedron10};

int levelsFor(Cell cell, int plane, int space) { return dimensionOf(cell) == 2 ? plane : space; }

}  // namespace

TEUCHOS_UNIT_TEST(Bisection, CutsAllMarkedElementsIntoFourOrEightOfEqualSize) {
  for (const Cell cell : cells) {
    const RefinableMesh start = refinable(boxes({box("body", cell, 3)}), {});
    const Refinement next = bisect(start, all(start.mesh));
    const int parts = 1 << dimensionOf(cell);
    TEST_EQUALITY(next.fine.mesh.elements(), parts * start.mesh.elements());
    for (int e = 0; e < next.fine.mesh.elements(); ++e)
      TEST_FLOATING_EQUALITY(sizeOf(next.fine.mesh, e), sizeOf(start.mesh, next.parent[e]) / parts, 1e-12);
    // Euler: the regular mesh of twice as many cells has as many nodes.
    TEST_EQUALITY(next.fine.mesh.nodes(), boxes({box("body", cell, 6)}).nodes());
  }
}

TEUCHOS_UNIT_TEST(Bisection, WithoutMarksIsTheSameMesh) {
  for (const Cell cell : cells) {
    const RefinableMesh start = refinable(stacked(cell, 2), contactTwins(stacked(cell, 2), contact()));
    const Refinement next = bisect(start, std::vector<char>(start.mesh.elements(), 0));
    TEST_EQUALITY(next.fine.mesh.hash(), start.mesh.hash());
  }
}

TEUCHOS_UNIT_TEST(Bisection, TowardsACornerKeepsBodiesGroupsShapesAndMatchingNodes) {
  for (const Cell cell : cells) {
    const Mesh mesh = stacked(cell, 2);
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    // Triangles and tetrahedra have finitely many shapes, which all appear in a few uniform refinements.
    RefinableMesh uniform = level;
    for (int k = 0; k < 3; ++k) uniform = bisect(uniform, all(uniform.mesh)).fine;
    const double worst = worstShape(uniform.mesh);
    for (int k = 0; k < levelsFor(cell, 14, 8); ++k) {
      const Refinement next = bisect(level, near(level.mesh, {0.5, dimensionOf(cell) == 2 ? 1.0 : 0.5, 1}));
      checkParents(next, level.mesh, out, success);
      level = next.fine;
      checkLevel(level, mesh, out, success);
      TEST_COMPARE(worstShape(level.mesh), >=, worst * (1 - 1e-6));
      TEST_ASSERT(facesCoincide(level.mesh));
      if (cell != Cell::Tetrahedron10) TEST_EQUALITY(unmatched(level.mesh), 0);  // its faces have no matching pairs
    }
    if (mesh.dimension == 2) TEST_COMPARE(smallestAngle(level.mesh), >=, smallestAngle(mesh) / 2);
    out << cellInfo(cell).name << ": " << level.mesh.elements() << " elements, shape " << worst << "\n";
  }
}

TEUCHOS_UNIT_TEST(Bisection, AtRandomKeepsBodiesGroupsShapesAndMatchingNodes) {
  for (const Cell cell : cells) {
    std::mt19937 random(7);
    const Mesh mesh = stacked(cell, 2);
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    RefinableMesh uniform = level;
    for (int k = 0; k < 3; ++k) uniform = bisect(uniform, all(uniform.mesh)).fine;
    const double worst = worstShape(uniform.mesh);
    for (int k = 0; k < levelsFor(cell, 12, 4); ++k) {
      level = bisect(level, atRandom(level.mesh, levelsFor(cell, 10, 3) / 100.0, random)).fine;
      checkLevel(level, mesh, out, success);
      TEST_COMPARE(worstShape(level.mesh), >=, worst * (1 - 1e-6));
      TEST_ASSERT(facesCoincide(level.mesh));
      if (cell != Cell::Tetrahedron10) TEST_EQUALITY(unmatched(level.mesh), 0);  // its faces have no matching pairs
    }
    out << cellInfo(cell).name << ": " << level.mesh.elements() << " elements, shape " << worst << "\n";
  }
}

TEUCHOS_UNIT_TEST(Bisection, CreatesElementsInProportionToTheMarkedOnes) {
  for (const Cell cell : {Cell::Triangle3, Cell::Tetrahedron4}) {
    RefinableMesh level = refinable(stacked(cell, 2), {});
    const int before = level.mesh.elements();
    int marks = 0;
    for (int k = 0; k < levelsFor(cell, 30, 12); ++k) {
      const std::vector<char> marked = near(level.mesh, {0, 0, 0});
      marks += static_cast<int>(std::count(marked.begin(), marked.end(), 1));
      level = bisect(level, marked).fine;
      TEST_COMPARE(level.mesh.elements() - before, <=, levelsFor(cell, 12, 40) * marks);
    }
    out << cellInfo(cell).name << ": " << level.mesh.elements() << " elements, " << marks << " marked\n";
  }
}

TEUCHOS_UNIT_TEST(Bisection, DoesNotDependOnTheNumbering) {
  for (const Cell cell : cells) {
    const Mesh mesh = stacked(cell, 2), other = renumbered(mesh, 3);
    RefinableMesh one = refinable(mesh, contactTwins(mesh, contact())), two = refinable(other, contactTwins(other, contact()));
    for (int k = 0; k < 4; ++k) {
      one = bisect(one, near(one.mesh, {0.3, 1, 1})).fine;
      two = bisect(two, near(two.mesh, {0.3, 1, 1})).fine;
      TEST_ASSERT(centres(one.mesh) == centres(two.mesh));
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, RefinesBothSidesOfAGapAlikeThoughOnlyOneIsMarked) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
    Mesh mesh = stacked(cell, 3);
    openGap(mesh);
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    for (int k = 0; k < levelsFor(cell, 10, 5); ++k) {
      std::vector<char> marked = near(level.mesh, {0.5, mesh.dimension == 2 ? 1.0 : 0.5, 1});
      for (int e = 0; e < level.mesh.elements(); ++e) marked[e] = marked[e] && level.mesh.bodyOfElement[e] == 0;
      level = bisect(level, marked).fine;
      checkLevel(level, mesh, out, success);
      TEST_EQUALITY(unmatched(level.mesh), 0);
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsFieldsOfItsOrderExactly) {
  for (const Cell cell : cells) {
    const int order = cellInfo(cell).order;
    const auto field = [&](const Point& p) {
      return 1 + 2 * p[0] - 3 * p[1] + p[2] + (order == 2 ? p[0] * p[1] - 2 * p[1] * p[2] + 3 * p[2] * p[2] - p[0] * p[0] : 0);
    };
    const Mesh mesh = stacked(cell, 2);
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    for (int k = 0; k < 4; ++k) {
      Matrix values(level.mesh.nodes(), 1);
      for (int n = 0; n < level.mesh.nodes(); ++n) values(n, 0) = field(level.mesh.point(n));
      const Refinement next = bisect(level, near(level.mesh, {0.4, 0.9, 0.8}));
      const Matrix fine = next.interpolated(level.mesh, values);
      TEST_EQUALITY(static_cast<int>(fine.rows()), next.fine.mesh.nodes());
      double worst = 0;
      for (int n = 0; n < next.fine.mesh.nodes(); ++n) worst = std::max(worst, std::abs(fine(n, 0) - field(next.fine.mesh.point(n))));
      TEST_COMPARE(worst, <, 1e-13);
      level = next.fine;
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsAxisymmetryRegionsAndNamedSubdomains) {
  Mesh mesh = stacked(Cell::Triangle6, 2);
  makeAxisymmetric(mesh);
  mesh.regions.assign(mesh.elements(), -1);
  for (const int e : mesh.elementGroups.at("lower_bricks_odd")) mesh.regions[e] = 4;
  RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
  for (int k = 0; k < 3; ++k) level = bisect(level, near(level.mesh, {0.5, 1, 0})).fine;
  TEST_ASSERT(level.mesh.axisymmetric);
  std::vector<int> expected(level.mesh.elements(), -1);
  for (const int e : level.mesh.elementGroups.at("lower_bricks_odd")) expected[e] = 4;
  TEST_ASSERT(level.mesh.regions == expected);
  TEST_ASSERT(level.mesh.elementGroups.count("subdomain_upper_1_0") == 1);
  for (int n = 0; n < level.mesh.nodes(); ++n) TEST_COMPARE(level.mesh.point(n)[0], >=, 0.0);
}

TEUCHOS_UNIT_TEST(Bisection, PlacesNewNodesOnCirclesAndSpheres) {
  for (const Cell cell : cells) {
    // A quarter of a ring, radius 1 to 2; in 3D turned about x, an eighth of a thick spherical shell without its pole.
    Mesh mesh = boxes({box("body", cell, cellInfo(cell).order == 2 ? 3 : 8)});
    const bool plane = mesh.dimension == 2;
    move(mesh, [&](const Point& p) {
      const double r = 1 + p[0], phi = p[1] * pi / 2, theta = plane ? 0 : (p[2] - 0.5) * pi / 3;
      return Point{r * std::cos(phi) * std::cos(theta), r * std::sin(phi) * std::cos(theta), r * std::sin(theta)};
    });
    RefinableMesh level = refinable(mesh, {});
    std::mt19937 random(5);
    for (int k = 0; k < levelsFor(cell, 4, 2); ++k) {
      level = bisect(level, atRandom(level.mesh, 0.3, random)).fine;
      assignBodies(level.mesh, {"body"});
      for (const auto& [name, radius] : {std::make_pair("body_left", 1.0), std::make_pair("body_right", 2.0)})
        for (const Side& side : level.mesh.sideGroups.at(name))
          for (const int node : level.mesh.nodesOf(side)) TEST_FLOATING_EQUALITY(norm(level.mesh.point(node)), radius, 1e-12);
    }
    out << cellInfo(cell).name << ": " << level.mesh.elements() << " elements, " << level.round.shapes.size() << " round shapes\n";
  }
}

TEUCHOS_UNIT_TEST(Bisection, LeavesPolygonsAsTheyAre) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6}) {
    Mesh square = boxes({box("body", cell, 1)});  // its four corners lie on a circle
    square.sideGroups["rim"] = {};
    for (const char* name : {"body_left", "body_right", "body_bottom", "body_top"})
      square.sideGroups["rim"].insert(square.sideGroups["rim"].end(), square.sideGroups[name].begin(), square.sideGroups[name].end());
    RefinableMesh level = refinable(square, {});
    TEST_EQUALITY(level.round.shapes.size(), std::size_t(0));
    for (int k = 0; k < 3; ++k) level = bisect(level, all(level.mesh)).fine;
    TEST_FLOATING_EQUALITY(sizeOfOutline(level.mesh), 4.0, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Bisection, OnTheCoarseSidesKeepsTheAreaOfCurvedElements) {
  Mesh mesh = boxes({box("body", Cell::Triangle6, 3)});
  move(mesh, [](const Point& p) { return Point{(1 + p[0]) * std::cos(p[1] * pi / 2), (1 + p[0]) * std::sin(p[1] * pi / 2), 0}; });
  // Area by the boundary integral of x dy along the parabolas, exact by Simpson's rule for a cubic integrand.
  const auto area = [](const Mesh& m) {
    double sum = 0;
    for (const auto& [name, sides] : m.sideGroups)
      for (const Side& side : sides) {
        const std::vector<int> n = m.nodesOf(side);
        const Point a = m.point(n[0]), b = m.point(n[1]), c = m.point(n[2]);
        const auto slope = [&](double s) { return (2 * s - 1) / 2 * a[1] + (2 * s + 1) / 2 * b[1] - 2 * s * c[1]; };
        sum += (a[0] * slope(-1) + 4 * c[0] * slope(0) + b[0] * slope(1)) / 3;
      }
    return sum;
  };
  RefinableMesh nested = refinable(mesh, {}, Boundary::Polygonal), round = refinable(mesh, {});
  double before = std::abs(area(mesh) - 3 * pi / 4);
  for (int k = 0; k < 3; ++k) {
    nested = bisect(nested, all(nested.mesh)).fine;
    TEST_FLOATING_EQUALITY(area(nested.mesh), area(mesh), 1e-13);
    round = bisect(round, all(round.mesh)).fine;
    const double error = std::abs(area(round.mesh) - 3 * pi / 4);
    TEST_COMPARE(error, <, before / 12);  // fourth order
    before = error;
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsBothFacesOfACrackMatching) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6}) {
    Mesh mesh = boxes({box("body", cell, 4)});
    // A slit along y = 1/2 from the left side to the middle: the elements below get nodes of their own, except at the tip.
    std::map<int, int> below;
    for (int e = 0; e < mesh.elements(); ++e) {
      if (centreOf(mesh, e)[1] > 0.5) continue;
      for (int k = mesh.offsets[e]; k < mesh.offsets[e + 1]; ++k) {
        const int node = mesh.connectivity[k];
        const Point p = mesh.point(node);
        if (p[1] != 0.5 || p[0] >= 0.5) continue;
        if (below.emplace(node, mesh.nodes()).second) mesh.coordinates.insert(mesh.coordinates.end(), {p[0], p[1]});
        mesh.connectivity[k] = below.at(node);
      }
    }
    for (int e = 0; e < mesh.elements(); ++e)
      for (int side = 0; side < 3; ++side) {
        const std::vector<int> n = mesh.nodesOf(Side{e, side});
        const Point a = mesh.point(n[0]), b = mesh.point(n[1]);
        if (a[1] != 0.5 || b[1] != 0.5 || a[0] + b[0] >= 1) continue;
        mesh.sideGroups[centreOf(mesh, e)[1] > 0.5 ? "above" : "below"].push_back({e, side});
      }
    assignBodies(mesh, {"body"});
    const std::vector<Contact> crack{Contact::between("above", "below")};
    RefinableMesh level = refinable(mesh, contactTwins(mesh, crack));
    TEST_FLOATING_EQUALITY(sizeOfOutline(level.mesh), 5.0, 1e-13);
    for (int k = 0; k < 10; ++k) {
      std::vector<char> marked = near(level.mesh, {0.5, 0.5, 0});
      for (int e = 0; e < level.mesh.elements(); ++e) marked[e] = marked[e] && centreOf(level.mesh, e)[1] > 0.5;
      level = bisect(level, marked).fine;
      assignBodies(level.mesh, {"body"});
      TEST_FLOATING_EQUALITY(sizeOfOutline(level.mesh), 5.0, 1e-13);
      TEST_EQUALITY(unmatched(level.mesh, crack.front()), 1);  // the tip
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsFourBodiesMatchingThatMeetAtAPoint) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
    const int up = dimensionOf(cell) - 1;
    std::vector<Box> all;
    for (const int i : {0, 1})
      for (const int j : {0, 1}) {
        all.push_back(box("body" + std::to_string(i) + std::to_string(j), cell, 2, j, j + 1));
        all.back().x0 = i;
        all.back().x1 = i + 1;
      }
    const Mesh mesh = boxes(all);
    const std::vector<Contact> contacts{Contact::between("body00_right", "body10_left"), Contact::between("body11_left", "body01_right"),
                                        Contact::between("body00_top", "body01_bottom"), Contact::between("body11_bottom", "body10_top")};
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contacts));
    Point meeting{1, 0.5, 0};
    meeting[up] = 1;
    for (int k = 0; k < levelsFor(cell, 10, 5); ++k) {
      std::vector<char> marked = near(level.mesh, meeting);
      for (int e = 0; e < level.mesh.elements(); ++e) marked[e] = marked[e] && level.mesh.bodyOfElement[e] == 2;
      level = bisect(level, marked).fine;
      assignBodies(level.mesh, mesh.bodies);
      TEST_FLOATING_EQUALITY(sizeOfOutline(level.mesh), sizeOfOutline(mesh), 1e-12);
      for (const Contact& each : contacts) TEST_EQUALITY(unmatched(level.mesh, each), 0);
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsNodesOppositeWhereAFaceContinuesBeyondTheContact) {
  for (const Cell cell : cells) {
    const bool plane = dimensionOf(cell) == 2;
    std::vector<Box> all{box("lower", cell, 2), box("upper", cell, 2, 1, 2)};
    all[0].x0 = -1;
    all[0].x1 = 2;
    all[0].nx = 6;
    const Mesh mesh = boxes(all);
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    TEST_COMPARE(level.twins.front().size(), >=, std::size_t(plane ? 3 : 9));
    for (int k = 0; k < levelsFor(cell, 8, 4); ++k) {
      level = bisect(level, near(level.mesh, {1, plane ? 1.0 : 0.5, 1})).fine;
      const NodePairs twins = contactTwins(level.mesh, contact()).front();
      std::set<int> upper;
      for (const Side& side : level.mesh.sideGroups.at("upper_bottom"))
        for (const int node : level.mesh.nodesOf(side)) upper.insert(node);
      TEST_EQUALITY(twins.size(), upper.size());
    }
  }
}

TEUCHOS_UNIT_TEST(Bisection, KeepsARoundFaceMatchingAcrossAGapAtAnyDepth) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
    // The lower face of the upper body is part of a circle, in 3D of a cylinder, of radius 4 that touches the lower body in its middle.
    Mesh mesh = boxes({box("lower", cell, 8), box("upper", cell, 8, 1, 2)});
    const int up = mesh.dimension - 1;
    for (int node = 0; node < mesh.nodes(); ++node) {
      double& height = mesh.coordinates[std::size_t(node) * mesh.dimension + up];
      const double x = mesh.point(node)[0];
      if (mesh.bodyOfNode[node] == 1) height += (4 - std::sqrt(16 - (x - 0.5) * (x - 0.5))) * (2 - height);
    }
    if (cell == Cell::Triangle6)  // mid-side nodes at the middles of the arcs, as meshers place them
      for (const Side& side : mesh.sideGroups.at("upper_bottom")) {
        const std::vector<int> n = mesh.nodesOf(side);
        const double a = std::asin((mesh.point(n[0])[0] - 0.5) / 4), b = std::asin((mesh.point(n[1])[0] - 0.5) / 4);
        mesh.coordinates[std::size_t(n[2]) * 2] = 0.5 + 4 * std::sin((a + b) / 2);
        mesh.coordinates[std::size_t(n[2]) * 2 + 1] = 5 - 4 * std::cos((a + b) / 2);
      }
    RefinableMesh level = refinable(mesh, contactTwins(mesh, contact()));
    TEST_EQUALITY(level.round.shapes.size(), std::size_t(1));
    for (int k = 0; k < levelsFor(cell, 14, 5); ++k) {
      level = bisect(level, near(level.mesh, {0.9, mesh.dimension == 2 ? 1.0 : 0.5, 1})).fine;
      assignBodies(level.mesh, mesh.bodies);
      TEST_EQUALITY(unmatched(level.mesh), 0);
      for (const Side& side : level.mesh.sideGroups.at("upper_bottom"))
        for (const int node : level.mesh.nodesOf(side)) {
          const Point p = level.mesh.point(node);
          TEST_FLOATING_EQUALITY(std::hypot(p[0] - 0.5, p[up] - 5), 4.0, 1e-13);
        }
    }
  }
}
