// One rank: numbering is local.
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/HilbertOrder.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace suture;

namespace {

Mesh grid(int cells, Cell cell, bool twice = false) {
  Box box;
  box.nx = box.ny = box.nz = cells;
  box.cell = cell;
  box.blocksX = 2;
  Box other = box;
  other.name = "other";
  other.x0 = 1, other.x1 = 2;
  return boxes(twice ? std::vector<Box>{box, other} : std::vector<Box>{box});
}

int nodesInCommon(const Mesh& mesh, int e, int f) {
  const auto a = mesh.nodesOf(e), b = mesh.nodesOf(f);
  const std::set<int> of(a.begin(), a.end());
  return static_cast<int>(std::count_if(b.begin(), b.end(), [&](int node) { return of.count(node) > 0; }));
}

// Content of a mesh, independent of its numbers: the elements of each group by the coordinates of their nodes, and the middles of the
// sides.
using Places = std::multiset<std::vector<double>>;

std::vector<double> placesOf(const Mesh& mesh, int e) {
  std::vector<double> places;
  for (const int node : mesh.nodesOf(e))
    for (int k = 0; k < mesh.dimension; ++k) places.push_back(mesh.point(node)[k]);
  return places;
}

std::map<std::string, Places> contents(const Mesh& mesh) {
  std::map<std::string, Places> all;
  for (int e = 0; e < mesh.elements(); ++e) all["all"].insert(placesOf(mesh, e));
  for (int e = 0; e < mesh.elements(); ++e) all["body " + std::to_string(mesh.bodyOfElement[e])].insert(placesOf(mesh, e));
  for (const auto& [name, elements] : mesh.elementGroups)
    for (const int e : elements) all["elements of " + name].insert(placesOf(mesh, e));
  for (const auto& [name, sides] : mesh.sideGroups)
    for (const Side& side : sides) {
      std::vector<double> places = placesOf(mesh, side.element);
      places.push_back(side.side);
      all["sides of " + name].insert(places);
    }
  return all;
}

}  // namespace

// The curve goes from each square of 2^n x 2^n to an adjacent one, from the lower left corner to the lower right one.
TEUCHOS_UNIT_TEST(HilbertOrder, GoesFromSquareToSquareAcrossASide) {
  const int cells = 32;
  Mesh mesh = grid(cells, Cell::Quadrilateral4);
  numberAlongHilbertCurve(mesh);
  TEST_EQUALITY(mesh.elements(), cells * cells);
  for (int e = 1; e < mesh.elements(); ++e) TEST_EQUALITY(nodesInCommon(mesh, e - 1, e), 2);
  const double first = 0.5 / cells;
  const Point begin = centreOf(mesh, 0), end = centreOf(mesh, mesh.elements() - 1);
  TEST_FLOATING_EQUALITY(begin[0], first, 1e-14);
  TEST_FLOATING_EQUALITY(begin[1], first, 1e-14);
  TEST_FLOATING_EQUALITY(end[0], 1 - first, 1e-14);
  TEST_FLOATING_EQUALITY(end[1], first, 1e-14);
}

// The curve runs from the origin to the far end of the x axis, and each run of 8^n elements, anywhere in the order, fills a cube.
TEUCHOS_UNIT_TEST(HilbertOrder, GoesFromCubeToCubeAcrossASide) {
  const int cells = 16;
  Mesh mesh = grid(cells, Cell::Hexahedron8);
  numberAlongHilbertCurve(mesh);
  TEST_EQUALITY(mesh.elements(), cells * cells * cells);
  for (int e = 1; e < mesh.elements(); ++e) TEST_EQUALITY(nodesInCommon(mesh, e - 1, e), 4);
  const double first = 0.5 / cells;
  const Point begin = centreOf(mesh, 0), end = centreOf(mesh, mesh.elements() - 1);
  for (int k = 0; k < 3; ++k) {
    TEST_FLOATING_EQUALITY(begin[k], first, 1e-14);
    TEST_FLOATING_EQUALITY(end[k], k == 0 ? 1 - first : first, 1e-14);
  }
  for (int width = 2; width < cells; width *= 2)
    for (int e = 0; e < mesh.elements(); e += width * width * width)
      for (int i = 0; i < width * width * width; ++i)
        for (int k = 0; k < 3; ++k) TEST_EQUALITY(int(centreOf(mesh, e + i)[k] * cells) / width, int(centreOf(mesh, e)[k] * cells) / width);
}

TEUCHOS_UNIT_TEST(HilbertOrder, NumbersNodesAsElementsMeetThem) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral9, Cell::Tetrahedron10, Cell::Pyramid5}) {
    Mesh mesh = grid(6, cell);
    numberAlongHilbertCurve(mesh);
    int met = 0;
    for (const int node : mesh.connectivity) {
      TEST_COMPARE(node, <=, met);
      met = std::max(met, node + 1);
    }
    TEST_EQUALITY(met, mesh.nodes());
  }
}

TEUCHOS_UNIT_TEST(HilbertOrder, KeepsElementsGroupsAndSides) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral8, Cell::Tetrahedron4, Cell::Hexahedron20}) {
    const Mesh before = grid(6, cell, true);
    Mesh after = before;
    numberAlongHilbertCurve(after);
    TEST_ASSERT(contents(after) == contents(before));
    TEST_ASSERT(after.connectivity != before.connectivity);
    for (const auto& group : after.elementGroups) TEST_ASSERT(std::is_sorted(group.second.begin(), group.second.end()));
    const std::string once = after.hash();
    numberAlongHilbertCurve(after);
    TEST_EQUALITY(after.hash(), once);
  }
}

// Points of a grid with spacing `h` along each axis.
std::vector<Point> gridOf(int nx, int ny, int nz, double h = 0.1) {
  std::vector<Point> points;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) points.push_back({h * i, h * j, h * k});
  return points;
}

int stepsBetween(const Point& a, const Point& b, double h = 0.1) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += std::abs(a[k] - b[k]) / h;
  return static_cast<int>(std::lround(sum));
}

// A row of squares (cubes) of 2^n points is traversed without a jump, along whichever axis it lies.
TEUCHOS_UNIT_TEST(HilbertOrder, OrdersPointsFromNeighbourToNeighbourInLongBoxes) {
  struct Case {
    int nx, ny, nz, dimension;
  };
  for (const Case c :
       {Case{16, 16, 1, 2}, {32, 8, 1, 2}, {8, 32, 1, 2}, {50, 1, 1, 2}, {8, 8, 8, 3}, {4, 4, 16, 3}, {8, 32, 8, 3}, {64, 1, 1, 3}}) {
    const std::vector<Point> points = gridOf(c.nx, c.ny, c.nz);
    const std::vector<int> order = orderAlongHilbertCurve(points, c.dimension);
    TEST_EQUALITY(std::set<int>(order.begin(), order.end()).size(), points.size());
    for (std::size_t k = 1; k < order.size(); ++k) TEST_EQUALITY(stepsBetween(points[order[k - 1]], points[order[k]]), 1);
  }
}

TEUCHOS_UNIT_TEST(HilbertOrder, OrdersPointsOfAPlateByItsPlane) {
  const std::vector<Point> points = gridOf(16, 16, 2);
  const std::vector<int> order = orderAlongHilbertCurve(points, 3);
  for (std::size_t k = 0; k < order.size(); k += 2) {
    TEST_EQUALITY(order[k] + 256, order[k + 1]);  // the upper one of two at the same place of the plane
    if (k > 0) TEST_EQUALITY(stepsBetween(points[order[k - 2]], points[order[k]]), 1);
  }
}

TEUCHOS_UNIT_TEST(HilbertOrder, DoesNotDependOnRoundOffOfPoints) {
  const std::vector<Point> points = gridOf(9, 17, 1);  // points on the halves of the box
  std::vector<Point> moved = points;
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (int k = 0; k < 2; ++k) moved[i][k] += 1e-13 * (static_cast<int>((7 * i + 3 * k) % 5) - 2);
  TEST_ASSERT(orderAlongHilbertCurve(points, 2) == orderAlongHilbertCurve(moved, 2));
  TEST_ASSERT(orderAlongHilbertCurve({}, 3).empty());
  TEST_ASSERT(orderAlongHilbertCurve({{1, 2, 3}, {1, 2, 3}}, 3) == (std::vector<int>{0, 1}));
}

// Nodes without elements are left for assignBodies() to report, with their coordinates.
TEUCHOS_UNIT_TEST(HilbertOrder, KeepsNodesOfNoElement) {
  Mesh mesh = grid(4, Cell::Triangle3);
  mesh.coordinates.insert(mesh.coordinates.begin(), {7, 8});
  mesh.bodyOfNode.insert(mesh.bodyOfNode.begin(), -1);
  for (int& node : mesh.connectivity) ++node;
  numberAlongHilbertCurve(mesh);
  TEST_EQUALITY(mesh.nodes(), 26);
  TEST_EQUALITY(mesh.point(25)[0], 7.0);
  TEST_EQUALITY(mesh.point(25)[1], 8.0);
  TEST_EQUALITY(mesh.bodyOfNode[25], -1);
}
