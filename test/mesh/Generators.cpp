#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <set>

#include <reader/MeshTesting.hpp>

using namespace suture;

namespace {

Box box(const std::string& name, double y0, double y1, Cell cell = Cell::Triangle3) {
  Box b;
  b.name = name;
  b.x0 = -1, b.x1 = 3, b.y0 = y0, b.y1 = y1;
  b.nx = 6, b.ny = 4;
  b.cell = cell;
  b.blocksX = 3, b.blocksY = 2;
  return b;
}

double areaOf(const Mesh& mesh, const std::vector<int>& elements) {
  double sum = 0;
  for (const int e : elements) sum += signedSize(mesh, e);
  return sum;
}

double lengthOf(const Mesh& mesh, const std::vector<Side>& sides) {
  double sum = 0;
  for (const Side& side : sides) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[1]);
    sum += std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  return sum;
}

}  // namespace

TEUCHOS_UNIT_TEST(Generators, FillTheBoxesWithEveryCell) {
  const std::pair<Cell, int> nodesOfOne[] = {{Cell::Triangle3, 7 * 5},
                                             {Cell::Triangle6, 13 * 9},
                                             {Cell::Quadrilateral4, 7 * 5},
                                             {Cell::Quadrilateral8, 13 * 9 - 24},
                                             {Cell::Quadrilateral9, 13 * 9}};
  for (const auto& [cell, nodes] : nodesOfOne) {
    const Mesh mesh = boxes({box("lower", 0, 2, cell), box("upper", 2, 3, cell)});
    TEST_EQUALITY(mesh.nodes(), 2 * nodes);
    TEST_EQUALITY(mesh.elements(), 2 * 24 * (cellInfo(cell).vertices == 3 ? 2 : 1));
    TEST_FLOATING_EQUALITY(areaOf(mesh, mesh.elementGroups.at("lower")), 8.0, 1e-13);
    TEST_FLOATING_EQUALITY(areaOf(mesh, mesh.elementGroups.at("upper")), 4.0, 1e-13);
    for (int e = 0; e < mesh.elements(); ++e) TEST_COMPARE(smallestJacobian(mesh, e), >, 0);
  }
}

TEUCHOS_UNIT_TEST(Generators, NameTheFourSides) {
  const Mesh mesh = boxes({box("lower", 0, 2), box("upper", 2, 3)});
  const std::pair<std::string, double> lengths[] = {{"lower_left", 2}, {"lower_right", 2}, {"lower_bottom", 4}, {"lower_top", 4},
                                                    {"upper_left", 1}, {"upper_right", 1}, {"upper_bottom", 4}, {"upper_top", 4}};
  for (const auto& [name, length] : lengths) TEST_FLOATING_EQUALITY(lengthOf(mesh, mesh.sideGroups.at(name)), length, 1e-13);
  for (const Side& side : mesh.sideGroups.at("upper_bottom"))
    for (const int node : mesh.nodesOf(side)) TEST_EQUALITY(mesh.point(node)[1], 2.0);
}

TEUCHOS_UNIT_TEST(Generators, ShareNoNodeButTheirPlaces) {
  const Mesh mesh = boxes({box("lower", 0, 2), box("upper", 2, 3)});
  std::set<double> below, above;
  for (const Side& side : mesh.sideGroups.at("lower_top"))
    for (const int node : mesh.nodesOf(side)) {
      TEST_EQUALITY(mesh.bodyOfNode[node], 0);
      below.insert(mesh.point(node)[0]);
    }
  for (const Side& side : mesh.sideGroups.at("upper_bottom"))
    for (const int node : mesh.nodesOf(side)) {
      TEST_EQUALITY(mesh.bodyOfNode[node], 1);
      above.insert(mesh.point(node)[0]);
    }
  TEST_EQUALITY(below.size(), std::size_t(7));
  TEST_ASSERT(below == above);
}

TEUCHOS_UNIT_TEST(Generators, AlternateTheDiagonals) {
  // Then inner nodes belong to eight and four triangles in turn; with parallel diagonals all would belong to six.
  const Mesh mesh = boxes({box("b", 0, 2)});
  std::vector<int> meets(mesh.nodes(), 0);
  for (const int node : mesh.connectivity) ++meets[node];
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 6; ++i) TEST_EQUALITY(meets[j * 7 + i], (i + j) % 2 == 0 ? 8 : 4);
}

TEUCHOS_UNIT_TEST(Generators, CutBoxesIntoEqualBlocks) {
  const Mesh mesh = boxes({box("b", 0, 2)});
  std::set<int> seen;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const auto& block = mesh.elementGroups.at("subdomain_b_" + std::to_string(i) + "_" + std::to_string(j));
      TEST_EQUALITY(block.size(), std::size_t(8));
      for (const int e : block) {
        TEST_ASSERT(seen.insert(e).second);
        const Point c = centreOf(mesh, e);
        TEST_EQUALITY(int(std::floor((c[0] + 1) / (4.0 / 3))), i);
        TEST_EQUALITY(int(std::floor(c[1])), j);
      }
    }
}

TEUCHOS_UNIT_TEST(Generators, LayBricksLikeAChessBoard) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral4}) {
    Box b = box("b", 0, 2, cell);  // 6 x 4 cells of 2/3 x 1/2 in bricks of 4 x 3: whole, then 2 x 3, 4 x 1, 2 x 1
    b.brickX = 4;
    b.brickY = 3;
    const Mesh mesh = boxes({b});
    const auto& even = mesh.elementGroups.at("b_bricks_even");
    const auto& odd = mesh.elementGroups.at("b_bricks_odd");
    TEST_EQUALITY(even.size() + odd.size(), std::size_t(mesh.elements()));
    TEST_FLOATING_EQUALITY(areaOf(mesh, even), (4 * 3 + 2 * 1) / 3.0, 1e-13);
    TEST_FLOATING_EQUALITY(areaOf(mesh, odd), (2 * 3 + 4 * 1) / 3.0, 1e-13);
    const double crossX = -1 + 4 * 2.0 / 3, crossY = 1.5;  // the point where four bricks meet
    for (const int e : even) TEST_COMPARE((centreOf(mesh, e)[0] - crossX) * (centreOf(mesh, e)[1] - crossY), >, 0);
    for (const int e : odd) TEST_COMPARE((centreOf(mesh, e)[0] - crossX) * (centreOf(mesh, e)[1] - crossY), <, 0);
    TEST_ASSERT(mesh.elementGroups.count("subdomain_b_2_1"));
    TEST_ASSERT(!boxes({box("b", 0, 2, cell)}).elementGroups.count("b_bricks_even"));
  }
}

TEUCHOS_UNIT_TEST(Generators, RefuseBadBoxesAllAtOnce) {
  Box empty = box("empty", 2, 1), uneven = box("uneven", 0, 1), none = box("none", 0, 1);
  uneven.blocksX = 4;
  none.nx = 0;
  Box single = box("single", 0, 1), half = box("half", 0, 1);
  single.brickX = 6;
  single.brickY = 9;
  half.brickY = 2;
  const std::string said = meshtesting::problemsOf([&] { boxes({empty, uneven, none, none, single, half}); });
  SUTURE_CHECK_SAYS(
      said,
      "Mesh/Boxes/single/Bricks: {6, 9} do not form a board of the cells {6, 4}; expected at least one cell in each direction and two");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/half/Bricks: {0, 2} do not form a board");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/empty/Y: an empty interval");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/uneven/Blocks: {4, 2} do not divide the cells {6, 4}");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/none/Cells: {0, 4}");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/none: a second box of this name");
}

TEUCHOS_UNIT_TEST(Generators, RefuseMeshesTooLargeForAnyMachine) {
  Box large = box("large", 0, 1);
  large.nx = large.ny = 1000000;
  large.blocksX = large.blocksY = 1;
  SUTURE_CHECK_SAYS(meshtesting::problemsOf([&] { boxes({large}); }),
                    "Mesh/Boxes: 2e+12 elements with 1000002000001 nodes; expected fewer than 2^31");
}
