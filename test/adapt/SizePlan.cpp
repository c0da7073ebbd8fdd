// Sizes of the next mesh: against the least cost of a wanted error by hand.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/adapt/SizePlan.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace suture {
namespace {

/// Triangles of first or second order on the unit square.
Mesh square(Cell cell, int cells) {
  Box box;
  box.name = "square";
  box.cell = cell;
  box.nx = box.ny = cells;
  return boxes({box});
}

constexpr double kAll = 1e9;  // no cap

TEUCHOS_UNIT_TEST(SizePlan, DividesAllSizesAlikeForAnEvenError) {
  // eta ~ h^k: half the error needs sizes 2^(-1/k) and 2^(d/k) times as many elements.
  for (const auto& [cell, order] : {std::pair<Cell, int>{Cell::Triangle3, 1}, {Cell::Triangle6, 2}}) {
    const Mesh mesh = square(cell, 4);
    const std::vector<double> squares(static_cast<std::size_t>(mesh.elements()), 2.0);
    const SizePlan plan = planSizes(mesh, squares, {}, {0.25 * 2.0 * mesh.elements(), kAll});
    TEST_FLOATING_EQUALITY(plan.elements, mesh.elements() * std::pow(2.0, 2.0 / order), 1e-10);
    const double area = 1.0 / mesh.elements(), size = std::sqrt(4 / std::sqrt(3.0) * area) * std::pow(2.0, -1.0 / order);
    for (int e = 0; e < mesh.elements(); ++e)
      for (int k = 0; k < 3; ++k) TEST_FLOATING_EQUALITY(plan.field.sizes[static_cast<std::size_t>(mesh.nodesOf(e)[k])], size, 1e-10);
    TEST_ASSERT(!plan.isCapped);
  }
}

/// Bodies far from each other, of two equal triangles (six tetrahedra) each, so that their sizes do not limit each other.
Mesh scattered(Cell cell, int bodies) {
  std::vector<Box> all;
  for (int k = 0; k < bodies; ++k) {
    Box box{"body" + std::to_string(k), 100.0 * k, 100.0 * k + 1, 0, 1, 1, 1, cell};
    box.nz = 1;
    all.push_back(box);
  }
  return boxes(all);
}

// Other sizes with the same error need more elements.
TEUCHOS_UNIT_TEST(SizePlan, HasTheFewestElements) {
  const int bodies = 8;
  std::mt19937 random(1);
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4, Cell::Tetrahedron10}) {
    const int degree = cellInfo(cell).order, dimension = dimensionOf(cell);
    const Mesh mesh = scattered(cell, bodies);
    const int each = mesh.elements() / bodies;
    std::vector<double> ofBody, squares;
    for (int k = 0; k < bodies; ++k) ofBody.push_back(std::uniform_real_distribution<double>(1, 30)(random));
    for (int e = 0; e < mesh.elements(); ++e) squares.push_back(ofBody[static_cast<std::size_t>(e / each)]);
    const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
    const SizePlan plan = planSizes(mesh, squares, {}, {0.25 * all, kAll}), twice = uniformSizes(mesh, 2.0);
    std::vector<double> ratio;
    for (int k = 0; k < bodies; ++k) {
      const auto node = static_cast<std::size_t>(mesh.nodesOf(k * each)[0]);
      ratio.push_back(2 * plan.field.sizes[node] / twice.field.sizes[node]);
    }
    const auto error = [&](const std::vector<double>& r) {
      double sum = 0;
      for (int k = 0; k < bodies; ++k)
        sum += each * ofBody[static_cast<std::size_t>(k)] * std::pow(r[static_cast<std::size_t>(k)], 2 * degree);
      return sum;
    };
    const auto count = [&](const std::vector<double>& r) {
      double sum = 0;
      for (const double one : r) sum += each * std::pow(one, -dimension);
      return sum;
    };
    TEST_FLOATING_EQUALITY(error(ratio), 0.25 * all, 0.1);  // sizes are rounded to eighths of a power of two
    TEST_FLOATING_EQUALITY(plan.elements, count(ratio), 1e-6);
    for (int trial = 0; trial < 100; ++trial) {
      std::vector<double> other = ratio;
      for (double& one : other) one *= std::uniform_real_distribution<double>(0.7, 1.4)(random);
      const double scale = std::pow(error(ratio) / error(other), 0.5 / degree);
      for (double& one : other) one *= scale;
      TEST_COMPARE(count(other), >, 0.99 * count(ratio));
    }
  }
}

TEUCHOS_UNIT_TEST(SizePlan, PutsSmallElementsWhereTheErrorIs) {
  const Mesh mesh = square(Cell::Triangle6, 16);
  std::vector<double> squares(static_cast<std::size_t>(mesh.elements()), 1e-6);
  squares[0] = 1.0;
  const SizePlan plan = planSizes(mesh, squares, {}, {0.1, kAll});
  const double old = std::sqrt(4 / std::sqrt(3.0) / mesh.elements());
  double least = 1e300, most = 0;
  for (const double size : plan.field.sizes) least = std::min(least, size), most = std::max(most, size);
  TEST_COMPARE(least, <, 0.75 * old);
  TEST_COMPARE(most, >, 1.5 * old);
  TEST_COMPARE(plan.elements, <, mesh.elements());
  // No size grows faster than half of the distance.
  for (int e = 0; e < mesh.elements(); ++e)
    for (const auto& edge : cellInfo(mesh.cells[e]).edges) {
      const int a = mesh.nodesOf(e)[edge[0]], b = mesh.nodesOf(e)[edge[1]];
      const double step = std::abs(plan.field.sizes[static_cast<std::size_t>(a)] - plan.field.sizes[static_cast<std::size_t>(b)]);
      TEST_COMPARE(step, <=, 0.5 * norm(minus(mesh.point(a), mesh.point(b))) + 1e-12);
    }
}

// The error around a re-entrant corner, u = r^1/2, second order: squares of h^4 r^-3. A plan by the order of the elements alone makes the
// elements at the corner smaller by less than three for a ninth of the squared error; their error falls only like h.
TEUCHOS_UNIT_TEST(SizePlan, RefinesSingularVerticesByTheirOwnOrder) {
  const Mesh mesh = square(Cell::Triangle6, 16);
  std::vector<double> squares;
  double all = 0, atCorner = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const double r = norm(centreOf(mesh, e)), square = std::pow(r, -5.0);
    squares.push_back(square);
    all += square;
    if (r < 1.0 / 16) atCorner += square;
  }
  TEST_COMPARE(atCorner, >, 0.5 * all);
  const SizePlan plan = planSizes(mesh, squares, {}, {all / 9, kAll});
  const double old = std::sqrt(4 / std::sqrt(3.0) / mesh.elements());
  double corner = 0, opposite = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (norm(mesh.point(node)) < 1e-9) corner = plan.field.sizes[static_cast<std::size_t>(node)];
    if (norm(mesh.point(node)) > 1.41) opposite = plan.field.sizes[static_cast<std::size_t>(node)];
  }
  TEST_COMPARE(corner, <, old / 9);
  TEST_COMPARE(corner, >, old / 512);
  TEST_FLOATING_EQUALITY(opposite, 2 * old, 1e-6);
}

TEUCHOS_UNIT_TEST(SizePlan, ObeysTheCap) {
  const Mesh mesh = square(Cell::Triangle3, 8);
  const std::vector<double> squares(static_cast<std::size_t>(mesh.elements()), 1.0);
  const SizePlan plan = planSizes(mesh, squares, {}, {1e-6, 200.0});
  TEST_ASSERT(plan.isCapped);
  TEST_COMPARE(plan.elements, <=, 200.0 * (1 + 1e-12));
  TEST_COMPARE(plan.elements, >, 150.0);
}

// A body of 5e-6 next to one of size 1: Gmsh merges points closer than 1e-8 of the extent.
TEUCHOS_UNIT_TEST(SizePlan, IsNotBelowWhatTheMesherResolves) {
  const Mesh mesh = boxes({{"large", 0, 1, 0, 1, 1, 1, Cell::Triangle3}, {"small", 9, 9 + 5e-6, 0, 5e-6, 1, 1, Cell::Triangle3}});
  const SizePlan plan = planSizes(mesh, {1e-6, 1e-6, 1.0, 1.0}, {}, {1e-9, kAll});
  const double extent = std::hypot(9 + 5e-6, 1), least = *std::min_element(plan.field.sizes.begin(), plan.field.sizes.end());
  TEST_FLOATING_EQUALITY(least, 1e-7 * extent, 1e-10);
}

TEUCHOS_UNIT_TEST(SizePlan, DoesNotDependOnRoundOff) {
  const Mesh mesh = square(Cell::Triangle6, 12);
  std::vector<double> squares, other;
  for (int e = 0; e < mesh.elements(); ++e) {
    squares.push_back(std::exp(-0.02 * e));
    other.push_back(squares.back() * (1 + 1e-11 * std::sin(e)));
  }
  const WantedError wanted{0.05, kAll};
  TEST_ASSERT(planSizes(mesh, squares, {}, wanted).field.sizes == planSizes(mesh, other, {}, wanted).field.sizes);
}

TEUCHOS_UNIT_TEST(SizePlan, GivesOppositeNodesTheSameSize) {
  Box lower, upper;
  lower.name = "lower", upper.name = "upper";
  lower.cell = upper.cell = Cell::Triangle6;
  lower.nx = lower.ny = upper.nx = upper.ny = 6;
  upper.y0 = 1, upper.y1 = 2;
  const Mesh mesh = boxes({lower, upper});
  std::vector<FacingNodes> facing;
  for (int a = 0; a < mesh.nodes(); ++a)
    for (int b = a + 1; b < mesh.nodes(); ++b)
      if (norm(minus(mesh.point(a), mesh.point(b))) < 1e-9) facing.push_back({a, b, 0.0});
  TEST_EQUALITY(static_cast<int>(facing.size()), 13);
  std::vector<double> squares(static_cast<std::size_t>(mesh.elements()), 1e-3);
  for (int e = 0; e < mesh.elements() / 2; ++e) squares[static_cast<std::size_t>(e)] = 1.0;  // the lower body only
  const SizePlan plan = planSizes(mesh, squares, facing, {10.0, kAll});
  for (const FacingNodes& pair : facing)
    TEST_EQUALITY(plan.field.sizes[static_cast<std::size_t>(pair.a)], plan.field.sizes[static_cast<std::size_t>(pair.b)]);
}

TEUCHOS_UNIT_TEST(SizePlan, KeepsContactsAboveTheirSlide) {
  const Mesh mesh = square(Cell::Triangle6, 8);
  const std::vector<double> squares(static_cast<std::size_t>(mesh.elements()), 1.0);
  const SizePlan plan = planSizes(mesh, squares, {{0, 1, 0.125, 0.03}}, {1e-3 * mesh.elements(), kAll});
  TEST_FLOATING_EQUALITY(plan.field.sizes[0], 0.06, 1e-12);
  TEST_FLOATING_EQUALITY(plan.field.sizes[1], 0.06, 1e-12);
  TEST_COMPARE(*std::min_element(plan.field.sizes.begin(), plan.field.sizes.end()), <, 0.04);
}

// Sizes from .01 at a corner of a triangle to .5: the integral of 1 / h^2, by quadrature along rays from the corner.
TEUCHOS_UNIT_TEST(SizePlan, CountsElementsOfGradedSizes) {
  for (const Cell cell : {Cell::Triangle3, Cell::Tetrahedron4}) {
    Mesh mesh = scattered(cell, 1);
    const int dimension = mesh.dimension;
    mesh.cells.resize(1);
    mesh.offsets.resize(2);
    mesh.connectivity.resize(static_cast<std::size_t>(dimension) + 1);
    std::vector<double> largest(static_cast<std::size_t>(mesh.nodes()), 1e9);
    for (int k = 0; k <= dimension; ++k) largest[static_cast<std::size_t>(mesh.nodesOf(0)[k])] = k == 0 ? 0.01 : 0.4;
    const SizePlan plan = planSizes(mesh, {1.0}, {}, {16.0, kAll}, largest);
    const double size = dimension == 2 ? std::sqrt(4 / std::sqrt(3.0) / 2) : std::cbrt(6 * std::sqrt(2.0) / 6);
    double count = 0;
    const int points = 20000;
    for (int i = 0; i < points; ++i) {  // s: part of the way from the corner to the opposite side, whose sizes are equal
      const double s = (i + 0.5) / points;
      count += dimension * std::pow(s, dimension - 1) / points * std::pow(size / (0.01 + 0.39 * s), dimension);
    }
    TEST_FLOATING_EQUALITY(plan.elements, count, 0.1);  // equal sizes count as slightly different
  }
}

}  // namespace
}  // namespace suture
