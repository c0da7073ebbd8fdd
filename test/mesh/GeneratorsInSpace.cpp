// 3D boxes, meshed with every cell.
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/Surface.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include <mesh/ReferenceCells.hpp>
#include <reader/MeshTesting.hpp>

using namespace suture;

namespace {

Box solidBox(const std::string& name, double z0, double z1, Cell cell) {
  Box b;
  b.name = name;
  b.x0 = -1, b.x1 = 3, b.y0 = 0, b.y1 = 1.5, b.z0 = z0, b.z1 = z1;
  b.nx = 4, b.ny = 3, b.nz = 2;
  b.cell = cell;
  return b;
}

double volumeOf(const Mesh& mesh, const std::vector<int>& elements) {
  double sum = 0;
  for (const int e : elements) sum += signedSize(mesh, e);
  return sum;
}

double areaOf(const Surface& surface) {
  double sum = 0;
  for (const auto& entry : surface.nodes()) sum += entry.second.tributary;
  return sum;
}

std::vector<Side> outsideOf(const Mesh& mesh, const std::string& name) {
  std::vector<Side> all;
  for (const char* end : {"_left", "_right", "_front", "_back", "_bottom", "_top"}) {
    const std::vector<Side>& some = mesh.sideGroups.at(name + end);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Each side as the set of its nodes' coordinates.
std::set<std::set<Point>> placesOf(const Mesh& mesh, const std::vector<Side>& sides) {
  std::set<std::set<Point>> all;
  for (const Side& side : sides) {
    std::set<Point> places;
    for (const int node : mesh.nodesOf(side)) places.insert(mesh.point(node));
    all.insert(places);
  }
  return all;
}

std::string numbered(const std::string& name, int i, int j, int k) {
  return name + "_" + std::to_string(i) + "_" + std::to_string(j) + "_" + std::to_string(k);
}

}  // namespace

// Vertices of 4 x 3 x 2 cells: 5 * 4 * 3 = 60; edges of the cells: 48 + 45 + 40; of half the cells' size: 9 * 7 * 5 = 315.
TEUCHOS_UNIT_TEST(GeneratorsInSpace, FillTheBoxesWithEveryCell) {
  struct Count {
    Cell cell;
    int nodes, elements;
  };
  for (const Count& count : {Count{Cell::Tetrahedron4, 60, 144}, Count{Cell::Tetrahedron10, 315, 144}, Count{Cell::Hexahedron8, 60, 24},
                             Count{Cell::Hexahedron20, 60 + 133, 24}, Count{Cell::Hexahedron27, 315, 24}, Count{Cell::Wedge6, 60, 48},
                             Count{Cell::Pyramid5, 60 + 24, 144}}) {
    const Mesh mesh = boxes({solidBox("lower", 0, 2, count.cell), solidBox("upper", 2, 3, count.cell)});
    TEST_EQUALITY(mesh.dimension, 3);
    TEST_EQUALITY(mesh.nodes(), 2 * count.nodes);
    TEST_EQUALITY(mesh.elements(), 2 * count.elements);
    TEST_FLOATING_EQUALITY(volumeOf(mesh, mesh.elementGroups.at("lower")), 12.0, 1e-13);
    TEST_FLOATING_EQUALITY(volumeOf(mesh, mesh.elementGroups.at("upper")), 6.0, 1e-13);
    for (int e = 0; e < mesh.elements(); ++e) TEST_COMPARE(smallestJacobian(mesh, e), >, 0);
    // Middle nodes lie in the middle: the cells are those of the code's drawings under an affine map.
    const CellInfo& info = cellInfo(count.cell);
    for (int e = 0; e < mesh.elements(); ++e)
      for (std::size_t k = 0; info.order == 2 && k < info.edges.size(); ++k) {
        const auto nodes = mesh.nodesOf(e);
        const Point sum = plus(mesh.point(nodes[info.edges[k][0]]), mesh.point(nodes[info.edges[k][1]]));
        TEST_COMPARE(norm(minus(scaled(0.5, sum), mesh.point(nodes[std::size_t(info.vertices) + k]))), <, 1e-15);
      }
  }
}

TEUCHOS_UNIT_TEST(GeneratorsInSpace, NameTheSixSides) {
  for (const Cell cell : referencecells::solid) {
    const Mesh mesh = boxes({solidBox("b", 1, 3, cell)});
    struct Face {
      std::string name;
      int direction;
      double place, area;
      Point outward;
    };
    for (const Face& face :
         {Face{"b_left", 0, -1, 3, {-1, 0, 0}}, Face{"b_right", 0, 3, 3, {1, 0, 0}}, Face{"b_front", 1, 0, 8, {0, -1, 0}},
          Face{"b_back", 1, 1.5, 8, {0, 1, 0}}, Face{"b_bottom", 2, 1, 6, {0, 0, -1}}, Face{"b_top", 2, 3, 6, {0, 0, 1}}}) {
      const Surface surface(mesh, mesh.sideGroups.at(face.name));
      TEST_FLOATING_EQUALITY(areaOf(surface), face.area, 1e-13);
      for (const auto& [node, data] : surface.nodes()) {
        TEST_EQUALITY(data.position[face.direction], face.place);
        TEST_ASSERT(surface.normal(node) == face.outward);
      }
      TEST_ASSERT(surface.branchings().empty());
      TEST_ASSERT(surface.parts() == std::vector<int>(surface.sides(), 0));
    }
    TEST_EQUALITY(mesh.sideGroups.size(), 6u);
  }
}

// The six sides together are the closed surface of the box and the boundary of the mesh.
TEUCHOS_UNIT_TEST(GeneratorsInSpace, HaveAClosedSurface) {
  for (const Cell cell : referencecells::solid) {
    const Mesh mesh = boxes({solidBox("b", 0, 2, cell)});
    const std::vector<Side> outside = outsideOf(mesh, "b");
    const Surface surface(mesh, outside);
    for (int side = 0; side < surface.sides(); ++side)
      for (int k = 0; k < surface.facets(side); ++k) TEST_COMPARE(surface.across(side, k).side, >=, 0);
    TEST_ASSERT(surface.branchings().empty());
    TEST_FLOATING_EQUALITY(areaOf(surface), 2 * (8 + 3 + 6.0), 1e-13);
    const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
    int boundary = 0;
    for (int e = 0; e < mesh.elements(); ++e)
      for (std::size_t s = 0; s < cellInfo(cell).sideNodes.size(); ++s) boundary += table.onBoundary({e, static_cast<int>(s)});
    TEST_EQUALITY(boundary, surface.sides());
    // Gauss: the volume is a third of the flux of the position, here by the exact areas at the vertices of linear sides.
    double flux = 0;
    for (const Side& side : outside) {
      const Surface one(mesh, {side});
      for (const auto& [node, data] : one.nodes()) flux += data.tributary * dot(data.position, one.normal(node));
    }
    TEST_FLOATING_EQUALITY(flux / 3, 12.0, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(GeneratorsInSpace, HaveMatchingSidesWhereBoxesMeet) {
  for (const Cell cell : referencecells::solid)
    for (const int layers : {1, 2}) {  // for any number of cells across
      Box lower = solidBox("lower", 0, 2, cell), upper = solidBox("upper", 2, 3, cell), behind = solidBox("behind", 0, 2, cell);
      lower.nz = layers;
      behind.nz = layers, behind.y0 = 1.5, behind.y1 = 2;
      const Mesh mesh = boxes({lower, upper, behind});
      const auto below = placesOf(mesh, mesh.sideGroups.at("lower_top")), above = placesOf(mesh, mesh.sideGroups.at("upper_bottom"));
      TEST_EQUALITY(below.size(), mesh.sideGroups.at("lower_top").size());
      TEST_ASSERT(below == above);
      TEST_ASSERT(placesOf(mesh, mesh.sideGroups.at("lower_back")) == placesOf(mesh, mesh.sideGroups.at("behind_front")));
      for (const Side& side : mesh.sideGroups.at("upper_bottom"))
        for (const int node : mesh.nodesOf(side)) TEST_EQUALITY(mesh.bodyOfNode[node], 1);
    }
}

TEUCHOS_UNIT_TEST(GeneratorsInSpace, CutBoxesIntoEqualBlocks) {
  for (const Cell cell : referencecells::solid) {
    Box b = solidBox("b", 0, 2, cell);
    b.blocksX = 2, b.blocksY = 3, b.blocksZ = 2;
    const Mesh mesh = boxes({b});
    std::set<int> seen;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 2; ++k) {
          const auto& block = mesh.elementGroups.at(numbered("subdomain_b", i, j, k));
          TEST_FLOATING_EQUALITY(volumeOf(mesh, block), 1.0, 1e-13);
          for (const int e : block) {
            TEST_ASSERT(seen.insert(e).second);
            const Point c = centreOf(mesh, e);
            TEST_EQUALITY(int(std::floor((c[0] + 1) / 2)), i);
            TEST_EQUALITY(int(std::floor(c[1] / 0.5)), j);
            TEST_EQUALITY(int(std::floor(c[2])), k);
          }
        }
    TEST_EQUALITY(static_cast<int>(seen.size()), mesh.elements());
  }
}

TEUCHOS_UNIT_TEST(GeneratorsInSpace, LayBricksLikeAChessBoard) {
  for (const Cell cell : {Cell::Tetrahedron4, Cell::Hexahedron8, Cell::Pyramid5}) {
    Box b = solidBox("b", 0, 2, cell);  // cells of 1 x 1/2 x 1 in bricks of 3 x 2 x 1
    b.brickX = 3, b.brickY = 2, b.brickZ = 1;
    const Mesh mesh = boxes({b});
    const Point cross{2, 1, 1};  // where eight bricks meet
    double even = 0;
    for (const char* name : {"b_bricks_even", "b_bricks_odd"})
      for (const int e : mesh.elementGroups.at(name)) {
        const Point c = centreOf(mesh, e);
        const double product = (c[0] - cross[0]) * (c[1] - cross[1]) * (c[2] - cross[2]);
        TEST_ASSERT((product < 0) == (std::string(name) == "b_bricks_even"));
        if (product < 0) even += signedSize(mesh, e);
      }
    TEST_FLOATING_EQUALITY(even, 3 + 0.5 + 1 + 1.5, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(GeneratorsInSpace, RefuseBadBoxesAllAtOnce) {
  Box empty = solidBox("empty", 2, 1, Cell::Hexahedron8), uneven = solidBox("uneven", 0, 1, Cell::Hexahedron8),
      none = solidBox("none", 0, 1, Cell::Wedge6);
  Box half = solidBox("half", 0, 1, Cell::Pyramid5), plane = solidBox("plane", 0, 1, Cell::Triangle6);
  uneven.blocksZ = 3;
  none.nz = 0;
  half.brickX = half.brickY = 2;
  const std::string said = meshtesting::problemsOf([&] { boxes({empty, uneven, none, half, plane}); });
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/empty/Z: an empty interval");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/uneven/Blocks: {1, 1, 3} do not divide the cells {4, 3, 2}");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/none/Cells: {4, 3, 0}");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/half/Bricks: {2, 2, 0} do not form a board of the cells {4, 3, 2}");
  SUTURE_CHECK_SAYS(said, "Mesh/Boxes/plane/Cell: Triangle6, but Hexahedron8 in 'empty'; expected all boxes in 2D or all in 3D");
}
