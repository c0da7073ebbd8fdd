// Search for the elements that contain points: all cells, straight and curved, in 2D and 3D.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <random>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellSearch.hpp>
#include <suture/mesh/Generators.hpp>

namespace suture {
namespace {

const std::vector<Cell> plane{Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9};
const std::vector<Cell> solid{Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron20,
                              Cell::Hexahedron27, Cell::Wedge6,        Cell::Pyramid5};

std::vector<Cell> all() {
  std::vector<Cell> cells = plane;
  cells.insert(cells.end(), solid.begin(), solid.end());
  return cells;
}

/// The unit square or cube, n cells along each axis.
CellBlock unitBox(Cell cell, int n) {
  Box box;
  box.nx = box.ny = box.nz = n;
  box.cell = cell;
  return boxes({box});
}

/// The same with a distorted inside: sides of second-order cells are curved, faces of hexahedra are not plane.
CellBlock bentBox(Cell cell, int n) {
  CellBlock block = unitBox(cell, n);
  const double pi = std::acos(-1.0);
  for (int node = 0; node < block.nodes(); ++node) {
    const Point p = block.point(node);
    double bump = 0.08;
    for (int k = 0; k < block.dimension; ++k) bump *= std::sin(pi * p[k]);
    for (int k = 0; k < block.dimension; ++k)
      block.coordinates[std::size_t(node) * block.dimension + k] += bump * std::cos(5 * p[(k + 1) % block.dimension] + k);
  }
  return block;
}

Point image(const CellBlock& block, int element, const ReferencePoint& at) {
  const Span<const int> nodes = block.nodesOf(element);
  ShapeJet jets[kMostCellNodes];
  shapeJets(block.cells[element], at, jets);
  Point sum{0, 0, 0};
  for (std::size_t a = 0; a < nodes.size(); ++a) sum = plus(sum, scaled(jets[a].value, block.point(nodes[a])));
  return sum;
}

double uniform(std::mt19937& random) { return random() / 4294967296.0; }

/// A place inside the reference cell, off its sides: a mean of its vertices with positive weights.
ReferencePoint inside(Cell cell, std::mt19937& random) {
  Point sum{0, 0, 0};
  double total = 0;
  for (int v = 0; v < cellInfo(cell).vertices; ++v) {
    const double weight = 0.02 + uniform(random);
    sum = plus(sum, scaled(weight, referencePoint(cell, v)));
    total += weight;
  }
  return scaled(1 / total, sum);
}

TEUCHOS_UNIT_TEST(CellSearch, FindsTheElementAndThePlaceInIt) {
  std::mt19937 random(3);
  for (const Cell cell : all())
    for (const int n : {1, 2, 4}) {
      const CellBlock block = bentBox(cell, n);
      const CellSearch search(block);
      for (int k = 0; k < 60; ++k) {
        const int element = int(random() % unsigned(block.elements()));
        const ReferencePoint at = inside(cell, random);
        const CellSearch::Place found = search.find(image(block, element, at));
        TEST_EQUALITY(found.element, element);
        TEST_EQUALITY(found.outside, 0.0);
        TEST_COMPARE(norm(minus(found.at, at)), <, 1e-10);
      }
    }
}

TEUCHOS_UNIT_TEST(CellSearch, FindsPointsAnywhereInGradedMeshes) {
  std::mt19937 random(5);
  for (const Cell cell : all()) {
    CellBlock block = unitBox(cell, dimensionOf(cell) == 2 ? 16 : 5);
    for (double& x : block.coordinates) x = std::pow(x, 4);
    const CellSearch search(block);
    for (int k = 0; k < 200; ++k) {
      const Point p{uniform(random), uniform(random), block.dimension == 2 ? 0.0 : uniform(random)};
      const CellSearch::Place found = search.find(p);
      TEST_ASSERT(found.element >= 0);
      if (found.element >= 0) TEST_COMPARE(norm(minus(image(block, found.element, found.at), p)), <, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(CellSearch, FindsNodesInTheLowestElementThatHasThem) {
  for (const Cell cell : all()) {
    const CellBlock block = unitBox(cell, 3);
    const CellSearch search(block);
    std::vector<int> lowest(block.nodes(), block.elements());
    for (int e = 0; e < block.elements(); ++e)
      for (const int node : block.nodesOf(e)) lowest[node] = std::min(lowest[node], e);
    for (int node = 0; node < block.nodes(); ++node) {
      const CellSearch::Place found = search.find(block.point(node));
      TEST_EQUALITY(found.element, lowest[node]);
      TEST_EQUALITY(found.outside, 0.0);
      TEST_COMPARE(norm(minus(image(block, found.element, found.at), block.point(node))), <, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(CellSearch, TakesAPointALittleOutsideForOneInTheElement) {
  const int n = 4;
  for (const Cell cell : all()) {
    const CellBlock block = unitBox(cell, n);
    const CellSearch search(block);
    const double z = block.dimension == 2 ? 0.0 : 0.45;
    for (const double off : {0.02, 0.1}) {
      const Point p{0.4, 1.0 + off / n, z};
      const CellSearch::Place found = search.find(p);
      TEST_EQUALITY(found.element >= 0, off < CellSearch::kNear);
      if (found.element < 0) continue;
      TEST_COMPARE(found.outside, >, 0.3 * off);
      TEST_COMPARE(found.outside, <, 2.1 * off);
      TEST_COMPARE(norm(minus(image(block, found.element, found.at), p)), <, 1e-12);
    }
  }
}

/// The nearest point of the unit box has its coordinates clipped to its sides.
TEUCHOS_UNIT_TEST(CellSearch, FindsTheNearestElementAndExtrapolates) {
  std::mt19937 random(7);
  for (const Cell cell : all())
    for (const double reach : {0.1, 20.0}) {
      const CellBlock block = unitBox(cell, 3);
      const CellSearch search(block);
      for (int k = 0; k < 100; ++k) {
        Point p{0, 0, 0}, foot{0, 0, 0};
        for (int c = 0; c < block.dimension; ++c) {
          p[c] = (1 + 2 * reach) * uniform(random) - reach;
          foot[c] = std::clamp(p[c], 0.0, 1.0);
        }
        const double distance = norm(minus(p, foot));
        if (distance == 0.0) continue;
        const CellSearch::Nearest found = search.nearest(p);
        TEST_FLOATING_EQUALITY(found.distance, distance, 1e-12);
        TEST_COMPARE(norm(minus(found.foot, foot)), <, 1e-12 * (1 + distance));
        TEST_COMPARE(found.outside, >=, CellSearch::kNear);
        // Near the box the map is extrapolated; farther away the projection counts.
        const Point there = image(block, found.element, found.at);
        if (reach < 1) TEST_COMPARE(norm(minus(there, p)), <, 1e-11);
        TEST_COMPARE(std::min(norm(minus(there, p)), norm(minus(there, foot))), <, 1e-11);
      }
    }
}

TEUCHOS_UNIT_TEST(CellSearch, FindsNothingWithoutElements) {
  const CellBlock nothing;
  const CellSearch search(nothing);
  TEST_EQUALITY(search.find({0, 0, 0}).element, -1);
  TEST_EQUALITY(search.nearest({0, 0, 0}).element, -1);
}

}  // namespace
}  // namespace suture
