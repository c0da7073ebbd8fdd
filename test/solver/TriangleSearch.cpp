#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/solver/nested/TriangleSearch.hpp>

namespace suture {
namespace {

using namespace blocks;

/// A square mesh of irregular cells, from [0, 1]^2; corners stay.
CellBlock irregular(Cell cell, int n) {
  Box box;
  box.nx = box.ny = n;
  box.cell = cell;
  CellBlock mesh = boxes({box});
  const Matrix shift = random(mesh.nodes(), 2, 3);
  const auto inside = [](double x) { return x > 1e-9 && x < 1 - 1e-9; };
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point p = mesh.point(node);
    if (inside(p[0]) && inside(p[1]))
      for (int k = 0; k < 2; ++k) mesh.coordinates[2 * node + k] += 0.2 / n * shift(node, k);
  }
  return mesh;
}

double area(const Point& a, const Point& b, const Point& c) {
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
}

/// Distance of a point from the nearest of all triangles: largest negative area coordinate, 0 inside one.
double leastOutside(const CellBlock& mesh, const Point& p) {
  double least = 1e300;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    for (int k = 1; k + 1 < cellInfo(mesh.cells[e]).vertices; ++k) {
      const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[k]), c = mesh.point(nodes[k + 1]);
      const double whole = area(a, b, c);
      least = std::min(least, std::max({0.0, -area(p, b, c) / whole, -area(a, p, c) / whole, -area(a, b, p) / whole}));
    }
  }
  return least;
}

/// Distance to the triangle that was found, as the ratio of its largest side.
double distanceInSizes(const CellBlock& mesh, const TriangleSearch::Place& place, const Point& p) {
  double nearest = 1e300, size = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Point q = mesh.point(place.nodes[c]), r = mesh.point(place.nodes[(c + 1) % 3]);
    nearest = std::min(nearest, std::hypot(q[0] - p[0], q[1] - p[1]));
    size = std::max(size, std::hypot(q[0] - r[0], q[1] - r[1]));
  }
  return nearest / size;
}

// Weights sum to one and give the point back: then they reproduce every linear field.
void interpolatesAt(const CellBlock& mesh, const TriangleSearch::Place& place, const Point& p, bool& success, Teuchos::FancyOStream& out) {
  Point sum{0, 0, 0};
  double one = 0.0;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 2; ++k) sum[k] += place.weights[c] * mesh.point(place.nodes[c])[k];
    one += place.weights[c];
  }
  TEST_COMPARE(std::abs(one - 1.0) + std::abs(sum[0] - p[0]) + std::abs(sum[1] - p[1]), <, 1e-12);
}

TEUCHOS_UNIT_TEST(TriangleSearch, FindsTheTriangleThatHoldsAPoint) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9})
    for (const int n : {1, 2, 7, 24}) {
      const CellBlock mesh = irregular(cell, n);
      const TriangleSearch search(mesh);
      const Matrix points = random(200, 2, 5);
      for (int k = 0; k < points.rows(); ++k) {
        const Point p{0.5 + 0.5 * points(k, 0), 0.5 + 0.5 * points(k, 1), 0};
        const TriangleSearch::Place place = search.find(p);
        TEST_EQUALITY(leastOutside(mesh, p) < 1e-12, true);  // the triangles cover the square
        TEST_COMPARE(place.outside, <, 1e-12);
        TEST_COMPARE(*std::min_element(place.weights.begin(), place.weights.end()), >, -1e-12);
        interpolatesAt(mesh, place, p, success, out);
      }
    }
}

// Cells that grow towards a corner: the largest lie in many bins.
TEUCHOS_UNIT_TEST(TriangleSearch, FindsTheTriangleInAGradedMesh) {
  CellBlock mesh = irregular(Cell::Triangle3, 24);
  for (double& x : mesh.coordinates) x = std::pow(x, 6);
  const TriangleSearch search(mesh);
  const Matrix points = random(500, 2, 5);
  for (int k = 0; k < points.rows(); ++k) {
    const Point p{0.5 + 0.5 * points(k, 0), 0.5 + 0.5 * points(k, 1), 0};
    TEST_COMPARE(leastOutside(mesh, p), <, 1e-12);
    TEST_COMPARE(search.find(p).outside, <, 1e-12);
    interpolatesAt(mesh, search.find(p), p, success, out);
  }
}

TEUCHOS_UNIT_TEST(TriangleSearch, FindsNodesAndMiddlesOfSides) {
  const CellBlock mesh = irregular(Cell::Triangle3, 9);
  const TriangleSearch search(mesh);
  for (int e = 0; e < mesh.elements(); ++e)
    for (int c = 0; c < 3; ++c) {
      const Point a = mesh.point(mesh.nodesOf(e)[c]), b = mesh.point(mesh.nodesOf(e)[(c + 1) % 3]);
      for (const double along : {0.0, 0.5}) {
        const Point p{a[0] + along * (b[0] - a[0]), a[1] + along * (b[1] - a[1]), 0};
        TEST_COMPARE(search.find(p).outside, <, 1e-12);
        interpolatesAt(mesh, search.find(p), p, success, out);
      }
    }
}

TEUCHOS_UNIT_TEST(TriangleSearch, FindsTheNearestForAPointNextToTheMesh) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral4}) {
    const int n = 12;
    const CellBlock mesh = irregular(cell, n);
    const TriangleSearch search(mesh);
    const Matrix points = random(200, 2, 7);
    for (int k = 0; k < points.rows(); ++k) {
      Point p{0.5 + 0.5 * points(k, 0), 1.0 + 0.3 / n * std::abs(points(k, 1)), 0};
      if (k % 4 >= 2) p[1] = 1.0 - p[1];
      if (k % 2 == 1) std::swap(p[0], p[1]);
      const TriangleSearch::Place place = search.find(p);
      TEST_FLOATING_EQUALITY(place.outside, leastOutside(mesh, p), 1e-9);
      TEST_COMPARE(place.outside, >, 0.0);
      TEST_COMPARE(distanceInSizes(mesh, place, p), <, 1.5);
      interpolatesAt(mesh, place, p, success, out);
    }
  }
}

// A ring of cells around a hole of many bins, and a point in the middle of it: whatever is answered, it is a triangle of the mesh.
TEUCHOS_UNIT_TEST(TriangleSearch, AnswersForPointsFarFromEverything) {
  Box box;
  box.x0 = box.y0 = -1;
  box.nx = box.ny = 40;
  const CellBlock whole = boxes({box});
  CellBlock ring;
  ring.coordinates = whole.coordinates;
  for (int e = 0; e < whole.elements(); ++e) {
    const Span<const int> nodes = whole.nodesOf(e);
    const Point p = whole.point(nodes[0]);
    if (std::max(std::abs(p[0]), std::abs(p[1])) < 0.7) continue;
    ring.cells.push_back(whole.cells[e]);
    ring.connectivity.insert(ring.connectivity.end(), nodes.begin(), nodes.end());
    ring.offsets.push_back(int(ring.connectivity.size()));
  }
  const TriangleSearch search(ring);
  for (const Point& p : {Point{0.02, 0.01, 0}, Point{0.3, -0.2, 0}, Point{7, 0.1, 0}, Point{-3, -5, 0}}) {
    const TriangleSearch::Place place = search.find(p);
    TEST_COMPARE(place.outside, <, 1e299);
    interpolatesAt(ring, place, p, success, out);
  }
}

TEUCHOS_UNIT_TEST(TriangleSearch, HasNoAnswerWithoutTriangles) {
  TEST_EQUALITY(TriangleSearch(CellBlock()).find({0, 0, 0}).outside, 1e300);
}

}  // namespace
}  // namespace suture
