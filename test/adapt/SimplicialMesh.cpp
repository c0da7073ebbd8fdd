#include <suture/adapt/SimplicialMesh.hpp>
#include <suture/mesh/SideFit.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <adapt/AdaptTesting.hpp>
#include <mesh/ReferenceCells.hpp>

using namespace suture;
using namespace adapttesting;

namespace {

Mesh stackedCells(Cell cell, int n) {
  std::vector<Box> all{box("lower", cell, n), box("upper", cell, n, 1, 2)};
  for (Box& each : all) each.brickX = each.brickY = each.brickZ = 1, each.blocksX = n;
  return boxes(all);
}

/// Two boxes have areas, volumes and sides that are known.
void checkUnitBoxes(const Mesh& given, int gap, Teuchos::FancyOStream& out, bool& success) {
  Mesh mesh = given;
  assignBodies(mesh, given.bodies);
  Problems problems;
  checkSidesFit(mesh, problems);
  TEST_ASSERT(problems.empty());
  TEST_ASSERT(mesh.bodyOfElement == given.bodyOfElement);
  TEST_ASSERT(mesh.bodyOfNode == given.bodyOfNode);
  for (int body = 0; body < 2; ++body) TEST_FLOATING_EQUALITY(sizeOfBody(mesh, body), 1.0, 1e-13);
  if (gap == 0) TEST_FLOATING_EQUALITY(sizeOfOutline(mesh), mesh.dimension == 2 ? 8.0 : 12.0, 1e-13);
  for (const auto& [name, sides] : mesh.sideGroups) TEST_FLOATING_EQUALITY(sizeOfGroup(mesh, name), 1.0, 1e-13);
}

/// Cells of several shapes that share sides: a cube, a pyramid on top, a wedge and tetrahedra at its sides.
Mesh mixed() {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.source = "mixed";
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},       {1, 0, 1},
                                  {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 1, 0}, {0.4, 0.6, 1.7}, {1.6, 0.5, 1.5}};
  for (const Point& p : points) mesh.coordinates.insert(mesh.coordinates.end(), p.begin(), p.end());
  const auto add = [&](Cell cell, const std::vector<int>& nodes) {
    mesh.elementGroups["body"].push_back(mesh.elements());
    mesh.cells.push_back(cell);
    mesh.connectivity.insert(mesh.connectivity.end(), nodes.begin(), nodes.end());
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  };
  add(Cell::Hexahedron8, {0, 1, 2, 3, 4, 5, 6, 7});
  add(Cell::Pyramid5, {4, 5, 6, 7, 10});
  add(Cell::Wedge6, {1, 5, 8, 2, 6, 9});  // its quadrilateral 1 5 6 2 is a side of the cube
  add(Cell::Pyramid5, {5, 8, 9, 6, 11});
  return mesh;
}

}  // namespace

TEUCHOS_UNIT_TEST(SimplicialMesh, FillsTheSameBodiesAndGroupsWithSimplicesOfEitherOrder) {
  for (const Cell cell : referencecells::all())
    for (const int order : {0, 1, 2}) {
      const Mesh mesh = stackedCells(cell, 2);
      const SimplicialMesh cut = simplicialMesh(mesh, order, contactTwins(mesh, contact()));
      const int wanted = order == 0 ? cellInfo(cell).order : order;
      for (const Cell each : cut.mesh.cells) {
        TEST_ASSERT(isSimplex(each));
        TEST_EQUALITY(cellInfo(each).order, wanted);
      }
      checkUnitBoxes(cut.mesh, 0, out, success);
      TEST_FLOATING_EQUALITY(largestBow(cut.mesh) + 1, 1.0, 1e-14);
      // Parents: the bricks of a parent are those of its parts.
      std::vector<double> filled(mesh.elements(), 0);
      for (int e = 0; e < cut.mesh.elements(); ++e) {
        filled[cut.parent[e]] += sizeOf(cut.mesh, e);
        TEST_COMPARE(norm(minus(centreOf(cut.mesh, e), centreOf(mesh, cut.parent[e]))), <, diameterOf(mesh, cut.parent[e]) / 2);
      }
      for (int e = 0; e < mesh.elements(); ++e) TEST_FLOATING_EQUALITY(filled[e], signedSize(mesh, e), 1e-13);
      for (const auto& [name, members] : mesh.elementGroups) {
        double before = 0, after = 0;
        for (const int e : members) before += signedSize(mesh, e);
        for (const int e : cut.mesh.elementGroups.at(name)) after += sizeOf(cut.mesh, e);
        TEST_FLOATING_EQUALITY(after, before, 1e-13);
      }
      // Nodes keep their places and order.
      TEST_EQUALITY(static_cast<int>(cut.nodeOfWhole.size()), cut.mesh.nodes());
      int last = -1;
      for (int n = 0; n < cut.mesh.nodes(); ++n) {
        if (cut.nodeOfWhole[n] < 0) continue;
        TEST_COMPARE(cut.nodeOfWhole[n], >, last);
        last = cut.nodeOfWhole[n];
        TEST_ASSERT(cut.mesh.point(n) == mesh.point(last));
      }
    }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, LeavesSimplicesAsTheyAre) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4, Cell::Tetrahedron10}) {
    const Mesh mesh = stackedCells(cell, 2);
    TEST_EQUALITY(simplicialMesh(mesh).mesh.hash(), mesh.hash());
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, IsConformingForWarpedCells) {
  for (const Cell cell : {Cell::Quadrilateral4, Cell::Hexahedron8, Cell::Wedge6, Cell::Pyramid5}) {
    Mesh mesh = stackedCells(cell, 4);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> shift(-0.04, 0.04);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Point p = mesh.point(node);
      bool inside = true;
      for (int k = 0; k < mesh.dimension; ++k)
        inside = inside && p[k] > 1e-9 && std::abs(p[k] - 1) > 1e-9 && p[k] < (k + 1 == mesh.dimension ? 2 : 1) - 1e-9;
      for (int k = 0; inside && k < mesh.dimension; ++k) mesh.coordinates[std::size_t(node) * mesh.dimension + k] += shift(random);
    }
    checkUnitBoxes(simplicialMesh(mesh, 1).mesh, 0, out, success);
    checkUnitBoxes(simplicialMesh(renumbered(mesh, 4), 2).mesh, 0, out, success);
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, IsConformingBetweenCellsOfDifferentShapes) {
  Mesh mesh = mixed();
  assignBodies(mesh, {"body"});
  double volume = 0;
  for (int e = 0; e < mesh.elements(); ++e) volume += signedSize(mesh, e);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Mesh cut = simplicialMesh(renumbered(mesh, seed), 1).mesh;
    TEST_EQUALITY(cut.elements(), 6 + 2 + 3 + 2);
    TEST_FLOATING_EQUALITY(sizeOfBody(cut, 0), volume, 1e-13);
    // Sum of the areas of the outer sides: all are planar.
    const Point top{0.4, 0.6, 1.7}, right{1.6, 0.5, 1.5};
    const auto triangle = [](const Point& a, const Point& b, const Point& c) { return norm(cross(minus(b, a), minus(c, a))) / 2; };
    double area = 4 + 2 * 0.5 + 1;  // cube: bottom, front, back, left; wedge: front, back, bottom
    const std::vector<Point> upper{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, slope{{1, 0, 1}, {2, 0, 0}, {2, 1, 0}, {1, 1, 1}};
    for (int k = 0; k < 4; ++k) area += triangle(upper[k], upper[(k + 1) % 4], top) + triangle(slope[k], slope[(k + 1) % 4], right);
    TEST_FLOATING_EQUALITY(sizeOfOutline(cut), area, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, KeepsMatchingFacesMatchingAcrossAGap) {
  for (const Cell cell : {Cell::Quadrilateral4, Cell::Quadrilateral9, Cell::Hexahedron8, Cell::Wedge6, Cell::Pyramid5}) {
    Mesh mesh = stackedCells(cell, 3);
    openGap(mesh);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Mesh other = renumbered(mesh, seed);
      const SimplicialMesh cut = simplicialMesh(other, 0, contactTwins(other, contact()));
      TEST_EQUALITY(unmatched(cut.mesh), 0);
      // And the levels that follow.
      RefinableMesh level = refinable(cut.mesh, contactTwins(cut.mesh, contact()));
      for (int k = 0; k < 2; ++k) level = bisect(level, near(level.mesh, {0.5, mesh.dimension == 2 ? 1 : 0.5, 1})).fine;
      TEST_EQUALITY(unmatched(level.mesh), 0);
    }
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, TouchingFacesMatchWithoutAListOfContacts) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Wedge6, Cell::Pyramid5}) {
    Mesh mesh = stackedCells(cell, 3);
    move(mesh, waved);
    TEST_EQUALITY(unmatched(simplicialMesh(mesh, 1).mesh), 0);
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, CutsQuadrilateralsAlongTheShorterDiagonal) {
  Mesh mesh = stackedCells(Cell::Quadrilateral4, 4);
  move(mesh, [](const Point& p) { return Point{p[0] + 0.6 * p[1], p[1], 0}; });  // leans to the right
  const Mesh cut = simplicialMesh(mesh).mesh;
  for (int e = 0; e < cut.elements(); ++e) TEST_COMPARE(diameterOf(cut, e), <, 0.292);  // shorter diagonal .269, sides .25 and .2915
}

TEUCHOS_UNIT_TEST(SimplicialMesh, KeepsCurvedSidesAndPlacesNewNodesOnCircles) {
  for (const Cell cell : referencecells::all()) {
    const bool second = cellInfo(cell).order == 2;
    Mesh mesh = boxes({box("body", cell, second ? 3 : 8)});
    const bool plane = mesh.dimension == 2;
    move(mesh, [&](const Point& p) {  // ring, in 3D a quarter of a thick pipe along z
      const double r = 1 + p[0], phi = p[1] * pi / 2;
      return Point{r * std::cos(phi), r * std::sin(phi), plane ? 0 : p[2]};
    });
    SimplicialMesh cut = simplicialMesh(mesh, 2);
    assignBodies(cut.mesh, {"body"});
    if (!second || cell != Cell::Hexahedron20)  // the map of 20 nodes has no node at the centre of a side
      for (const auto& [name, radius] : {std::make_pair("body_left", 1.0), std::make_pair("body_right", 2.0)})
        for (const Side& side : cut.mesh.sideGroups.at(name))
          for (const int node : cut.mesh.nodesOf(side)) {
            const Point p = cut.mesh.point(node);
            TEST_FLOATING_EQUALITY(std::hypot(p[0], p[1]), radius, 1e-12);
          }
    TEST_COMPARE(largestBow(cut.mesh), >, 1e-3);
    straightenEdges(cut.mesh);
    TEST_COMPARE(largestBow(cut.mesh), <, 1e-15);
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, KeepsAxisymmetryAndRegions) {
  Mesh mesh = stackedCells(Cell::Quadrilateral8, 3);
  makeAxisymmetric(mesh);
  mesh.regions.assign(mesh.elements(), -1);
  for (const int e : mesh.elementGroups.at("upper_bricks_even")) mesh.regions[e] = 1;
  const Mesh cut = simplicialMesh(mesh).mesh;
  TEST_ASSERT(cut.axisymmetric);
  std::vector<int> expected(cut.elements(), -1);
  for (const int e : cut.elementGroups.at("upper_bricks_even")) expected[e] = 1;
  TEST_ASSERT(cut.regions == expected);
}

TEUCHOS_UNIT_TEST(SimplicialMesh, InterpolatesFieldsOfItsOrder) {
  for (const Cell cell : referencecells::all()) {
    const Mesh mesh = stackedCells(cell, 2);
    const auto field = [](const Point& p) { return 1 + 2 * p[0] - 3 * p[1] + 5 * p[2]; };
    Matrix values(mesh.nodes(), 1);
    for (int n = 0; n < mesh.nodes(); ++n) values(n, 0) = field(mesh.point(n));
    const SimplicialMesh cut = simplicialMesh(mesh, 2);
    const Matrix added = valuesAt(mesh, cut.origins, values);
    const int kept = cut.mesh.nodes() - static_cast<int>(cut.origins.size());
    for (int n = kept; n < cut.mesh.nodes(); ++n) {
      TEST_EQUALITY(cut.nodeOfWhole[n], -1);
      TEST_FLOATING_EQUALITY(added(n - kept, 0) + 10, field(cut.mesh.point(n)) + 10, 1e-14);
    }
  }
}

TEUCHOS_UNIT_TEST(SimplicialMesh, RefusesCellsThatNoCutLeavesPositive) {
  Mesh mesh = boxes({box("body", Cell::Hexahedron8, 1)});
  move(mesh, [](const Point& p) {  // the top turned by 100 degrees
    const double x = p[0] - 0.5, y = p[1] - 0.5, a = p[2] * 100 * pi / 180;
    return Point{x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a), p[2]};
  });
  TEST_THROW(simplicialMesh(mesh, 1), InputError);
  try {
    simplicialMesh(mesh, 1);
  } catch (const InputError& error) {
    TEST_INEQUALITY(std::string(error.what()).find("too warped to be cut into tetrahedra"), std::string::npos);
  }
}
