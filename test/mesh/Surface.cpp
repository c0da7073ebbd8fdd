// Surfaces known by hand: lines in 2D, and the faces of cubes in 3D.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Surface.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace suture;

namespace {

const double pi = std::acos(-1.0);
using SideNodes = std::vector<int>;

Mesh square(int nx, int ny, Cell cell = Cell::Quadrilateral4) {
  Box box;
  box.name = "box";
  box.nx = nx, box.ny = ny, box.cell = cell;
  return boxes({box});
}

std::vector<Side> ring(const Mesh& mesh) {
  std::vector<Side> all;
  for (const char* name : {"box_top", "box_left", "box_bottom", "box_right"})
    for (const Side& side : mesh.sideGroups.at(name)) all.push_back(side);
  return all;
}

int nodeAt(const Surface& surface, const Point& place) {
  for (const auto& [node, data] : surface.nodes())
    if (norm(minus(data.position, place)) < 1e-12) return node;
  return -1;
}

/// The unit cube: corner x + 2 y + 4 z.
std::vector<Point> corners() {
  std::vector<Point> all;
  for (int i = 0; i < 8; ++i) all.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return all;
}
/// Its faces, counter-clockwise from outside: below, above, front, back, left, right.
const std::vector<SideNodes> faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

std::vector<SideNodes> triangles() {
  std::vector<SideNodes> all;
  for (const SideNodes& f : faces) all.push_back({f[0], f[1], f[2]}), all.push_back({f[0], f[2], f[3]});
  return all;
}

/// Faces with nodes in the middles of edges, and of faces; these are numbered from 8.
std::vector<SideNodes> secondOrder(std::vector<Point>& points, const std::vector<SideNodes>& linear, bool centre) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<SideNodes> all;
  const auto middle = [&](const std::vector<int>& of) {
    Point sum{0, 0, 0};
    for (const int node : of) sum = plus(sum, points[node]);
    points.push_back(scaled(1.0 / double(of.size()), sum));
    return int(points.size()) - 1;
  };
  for (const SideNodes& side : linear) {
    SideNodes nodes = side;
    for (std::size_t k = 0; k < side.size(); ++k) {
      const auto edge = std::minmax(side[k], side[(k + 1) % side.size()]);
      if (!middles.count(edge)) middles[edge] = middle({edge.first, edge.second});
      nodes.push_back(middles.at(edge));
    }
    if (centre) nodes.push_back(middle(side));
    all.push_back(nodes);
  }
  return all;
}

/// Checks that neighbours share a facet, traverse it in opposite directions, and refer to each other; returns the number of facets on the
/// rim.
int rimOf(const Surface& surface, Teuchos::FancyOStream& out, bool& success) {
  int rim = 0;
  for (int side = 0; side < surface.sides(); ++side)
    for (int k = 0; k < surface.facets(side); ++k) {
      const Surface::Facet& other = surface.across(side, k);
      if (other.side < 0) {
        ++rim;
        continue;
      }
      const auto end = [&](int of, int facet) { return surface.nodesOf(of)[facet % surface.facets(of)]; };
      TEST_EQUALITY(surface.across(other.side, other.facet).side, side);
      TEST_EQUALITY(surface.across(other.side, other.facet).facet, k);
      if (surface.dimension() == 2) {
        TEST_EQUALITY(end(side, k), end(other.side, other.facet));
        TEST_EQUALITY(other.facet, 1 - k);
      } else {
        TEST_EQUALITY(end(side, k), end(other.side, other.facet + 1));
        TEST_EQUALITY(end(side, k + 1), end(other.side, other.facet));
      }
    }
  return rim;
}

double area(const Surface& surface) {
  double sum = 0;
  for (const auto& entry : surface.nodes()) sum += entry.second.tributary;
  return sum;
}

}  // namespace

TEUCHOS_UNIT_TEST(Surface, KnowsTheNeighboursAlongALineAndARing) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral8}) {
    const Mesh mesh = square(5, 3, cell);
    const Surface line(mesh, mesh.sideGroups.at("box_bottom")), all(mesh, ring(mesh));
    TEST_EQUALITY(rimOf(line, out, success), 2);
    TEST_EQUALITY(rimOf(all, out, success), 0);
    TEST_EQUALITY(all.sides(), 16);
    TEST_ASSERT(all.branchings().empty());
    TEST_ASSERT(all.parts() == std::vector<int>(16, 0));
    TEST_FLOATING_EQUALITY(area(line), 1.0, 1e-14);
    const double h = cell == Cell::Triangle3 ? 0.2 : 0.1;
    const int node = nodeAt(line, {0.4, 0, 0});
    TEST_FLOATING_EQUALITY(line.at(node).spacing, h, 1e-14);
    TEST_ASSERT(line.normal(node) == (Point{0, -1, 0}));
    TEST_FLOATING_EQUALITY(line.at(node).tributary, cell == Cell::Triangle3 ? 0.2 : 0.2 / 3, 1e-14);
    // The corner of the square: normals of both sides, their mean.
    const int corner = nodeAt(all, {1, 1, 0});
    TEST_EQUALITY(all.at(corner).sideNormals.size(), 2u);
    std::set<int> beside{nodeAt(all, {1 - h, 1, 0}), nodeAt(all, {1, 1 - (cell == Cell::Triangle3 ? 1 : 0.5) / 3, 0})};
    TEST_ASSERT(std::set<int>(all.at(corner).beside.begin(), all.at(corner).beside.end()) == beside);
    TEST_EQUALITY(all.nodesNear(corner).size(), 5u);
  }
}

TEUCHOS_UNIT_TEST(Surface, NumbersPartsByTheirLowestNodes) {
  const Mesh mesh = square(4, 4);
  std::vector<Side> sides = mesh.sideGroups.at("box_top");
  const std::vector<Side>& bottom = mesh.sideGroups.at("box_bottom");  // nodes below those of the top
  sides.insert(sides.end(), bottom.begin(), bottom.end());
  TEST_ASSERT(Surface(mesh, sides).parts() == (std::vector<int>{1, 1, 1, 1, 0, 0, 0, 0}));
}

TEUCHOS_UNIT_TEST(Surface, HasTributaryAreasOfTheWholeCircleInAxisymmetricMeshes) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral8}) {
    Box box;
    box.name = "box";
    box.x1 = 4, box.nx = 8, box.ny = 2, box.cell = cell;
    Mesh mesh = boxes({box});
    assignBodies(mesh, {"box"});
    for (int node = 0; node < mesh.nodes(); ++node)  // the bottom becomes a cone of slant 5, radius 4
      mesh.coordinates[2 * std::size_t(node) + 1] += 0.75 * mesh.coordinates[2 * std::size_t(node)];
    makeAxisymmetric(mesh);
    const Surface cone(mesh, mesh.sideGroups.at("box_bottom"));
    TEST_FLOATING_EQUALITY(area(cone), pi * 4 * 5, 1e-13);
    if (cell != Cell::Triangle3) continue;
    // On the axis the volume of the cone of height one of its hat function: pi r s / 3; at the rim by the same integral.
    const double h = 0.5, slant = 0.625;
    TEST_FLOATING_EQUALITY(cone.at(nodeAt(cone, {0, 0, 0})).tributary, pi * h * slant / 3, 1e-13);
    TEST_FLOATING_EQUALITY(cone.at(nodeAt(cone, {4, 3, 0})).tributary, pi * slant * (4 - h / 3), 1e-13);
    TEST_FLOATING_EQUALITY(cone.at(nodeAt(cone, {1, 0.75, 0})).tributary, 2 * pi * slant * 1.0, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Surface, KnowsTheNeighboursOnACube) {
  const Surface cube(3, corners(), faces), halved(3, corners(), triangles());
  TEST_EQUALITY(rimOf(cube, out, success), 0);
  TEST_EQUALITY(rimOf(halved, out, success), 0);
  TEST_ASSERT(cube.parts() == std::vector<int>(6, 0) && halved.parts() == std::vector<int>(12, 0));
  // The face below, (0 2 3 1): across the edge 0-2 lies the left one, then back, right, front.
  const int expected[] = {4, 3, 5, 2};
  for (int k = 0; k < 4; ++k) TEST_EQUALITY(cube.across(0, k).side, expected[k]);
  TEST_EQUALITY(halved.across(0, 2).side, 1);  // the diagonal
  TEST_ASSERT(cube.at(0).beside == (std::vector<int>{1, 2, 4}));
  TEST_ASSERT(cube.nodesNear(0) == (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  TEST_EQUALITY(cube.at(0).spacing, 1.0);
}

TEUCHOS_UNIT_TEST(Surface, HasNormalsAndAreasOfACube) {
  const Surface cube(3, corners(), faces), halved(3, corners(), triangles());
  for (int i = 0; i < 8; ++i) {
    const Point outward = scaled(2 / std::sqrt(3.0), minus(corners()[i], {0.5, 0.5, 0.5}));
    TEST_COMPARE(norm(minus(cube.normal(i), outward)), <, 1e-15);
    TEST_FLOATING_EQUALITY(cube.at(i).tributary, 3.0 / 4, 1e-14);
    TEST_FLOATING_EQUALITY(halved.at(i).tributary, double(halved.at(i).sideNormals.size()) / 6, 1e-14);
    for (const Surface* surface : {&cube, &halved})
      for (const Point& normal : surface->at(i).sideNormals) {
        TEST_FLOATING_EQUALITY(norm(normal), 1.0, 1e-15);
        TEST_FLOATING_EQUALITY(dot(normal, outward), 1 / std::sqrt(3.0), 1e-14);
      }
  }
  TEST_FLOATING_EQUALITY(area(cube), 6.0, 1e-14);
  TEST_FLOATING_EQUALITY(area(halved), 6.0, 1e-14);
}

// Integrals of second-order shape functions over a unit square and half of it are known: vertices of six- and eight-node sides have zero or
// negative ones, and still a normal.
TEUCHOS_UNIT_TEST(Surface, HasTributaryAreasOfSecondOrderSides) {
  struct Kind {
    std::vector<SideNodes> linear;
    bool centre;
    double vertex, middle, whole;
  };
  for (const Kind& kind : {Kind{triangles(), false, 0, 0.5 / 3, 0}, Kind{faces, false, -1.0 / 12, 1.0 / 3, 0},
                           Kind{faces, true, 1.0 / 36, 1.0 / 9, 4.0 / 9}}) {
    std::vector<Point> points = corners();
    const std::vector<SideNodes> sides = secondOrder(points, kind.linear, kind.centre);
    const Surface surface(3, points, sides);
    TEST_EQUALITY(rimOf(surface, out, success), 0);
    TEST_FLOATING_EQUALITY(area(surface), 6.0, 1e-13);
    for (const auto& [node, data] : surface.nodes()) {
      const double meeting = double(data.sideNormals.size());
      const double one = node < 8 ? kind.vertex : meeting == 1 ? kind.whole : kind.middle;
      TEST_COMPARE(std::abs(data.tributary - meeting * one), <, 1e-14);
      if (node < 8) TEST_EQUALITY(data.spacing, 0.5);
      TEST_COMPARE(dot(surface.normal(node), unit(minus(data.position, {0.5, 0.5, 0.5}))), >, 0.8);
    }
  }
}

TEUCHOS_UNIT_TEST(Surface, FindsRimsPartsAndBranches) {
  std::vector<SideNodes> open(faces.begin() + 1, faces.end());  // without the face below
  TEST_EQUALITY(rimOf(Surface(3, corners(), open), out, success), 4);
  const Surface opposite(3, corners(), {faces[1], faces[0]});
  TEST_EQUALITY(rimOf(opposite, out, success), 8);
  TEST_ASSERT(opposite.parts() == (std::vector<int>{1, 0}));
  // Three sides at the edge 0-1; two that traverse it in the same direction; a line whose pieces meet head to head.
  std::vector<Point> points = corners();
  points.push_back({0, -1, 0});
  points.push_back({1, -1, 0});
  std::vector<SideNodes> three = faces;
  three.push_back({0, 8, 9, 1});
  TEST_ASSERT(Surface(3, points, three).branchings() == (std::vector<int>{0, 1}));
  TEST_ASSERT(Surface(3, points, {faces[2], {0, 1, 9, 8}}).branchings() == (std::vector<int>{0, 1}));
  TEST_ASSERT(Surface(2, points, {{0, 1}, {3, 1}}).branchings() == (std::vector<int>{1}));
}

// A patch of a cylinder of radius 2 as one side of nine nodes: area and normals to the order of its parabolas.
TEUCHOS_UNIT_TEST(Surface, FollowsACurvedSide) {
  const double angle = 0.4;
  std::vector<Point> points;
  for (const auto& [s, t] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}})
    points.push_back({2 * std::cos(s * angle / 2), 2 * std::sin(s * angle / 2), 0.5 * t});
  const Surface patch(3, points, {{0, 1, 2, 3, 4, 5, 6, 7, 8}});
  TEST_FLOATING_EQUALITY(area(patch), 2 * angle * 1.0, 1e-4);
  for (const auto& [node, data] : patch.nodes())
    TEST_COMPARE(norm(minus(patch.normal(node), {data.position[0] / 2, data.position[1] / 2, 0})), <, 5e-3);
}
