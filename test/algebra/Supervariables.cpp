#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/elimination/Supervariables.hpp>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace suture {
namespace {

/// Nodes of a grid, all nodes of a cell coupled, with the given number of unknowns each; some unknowns are left out, as held ones are.
struct NodeGrid {
  SparseMatrix matrix;
  std::vector<int> nodeOf;

  NodeGrid(int nx, int ny, int nz, int unknowns, const std::vector<int>& without = {}) {
    for (int node = 0; node < nx * ny * nz; ++node)
      for (int k = 0; k < unknowns; ++k)
        if (!std::count(without.begin(), without.end(), unknowns * node + k)) nodeOf.push_back(node);
    const int n = static_cast<int>(nodeOf.size());
    const auto far = [](int a, int b) { return std::abs(a - b) > 1; };
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = nodeOf[i], b = nodeOf[j];
        if (far(a % nx, b % nx) || far(a / nx % ny, b / nx % ny) || far(a / nx / ny, b / nx / ny)) continue;
        entries.emplace_back(i, j, i == j ? 100.0 + i : -0.1 - 0.01 * ((i + j) % 7));
      }
    matrix = SparseMatrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
  }
};

TEUCHOS_UNIT_TEST(Supervariables, AreTheNodes) {
  // Two nodes lack one and two unknowns; a third is missing completely.
  const NodeGrid grid(4, 3, 3, 3, {10, 30, 31, 60, 61, 62});
  const Supervariables nodes(grid.matrix, static_cast<int>(grid.matrix.rows()));
  TEST_EQUALITY(nodes.count(), 4 * 3 * 3 - 1);
  std::vector<int> order(nodes.count()), unknowns(grid.nodeOf.size());
  std::iota(order.rbegin(), order.rend(), 0);
  nodes.expand(order, unknowns.data());
  for (std::size_t i = 1; i < unknowns.size(); ++i) {
    const int before = grid.nodeOf[unknowns[i - 1]], now = grid.nodeOf[unknowns[i]];
    TEST_ASSERT(now < before || (now == before && unknowns[i] == unknowns[i - 1] + 1));
  }
}

TEUCHOS_UNIT_TEST(Supervariables, ReadTheLowerTriangleOnly) {
  const NodeGrid grid(5, 4, 1, 2, {13});
  const int n = static_cast<int>(grid.matrix.rows());
  const SparseMatrix lower = grid.matrix.triangularView<Eigen::Lower>();
  for (const int size : {n, n - 7, 1}) {
    const Supervariables both(grid.matrix, size), one(lower, size);
    TEST_EQUALITY(both.count(), one.count());
    TEST_EQUALITY((Matrix(both.graph(grid.matrix)) - Matrix(one.graph(lower))).norm(), 0.0);
  }
}

TEUCHOS_UNIT_TEST(Supervariables, TheirGraphIsThatOfTheNodes) {
  const NodeGrid grid(4, 4, 2, 3), nodes(4, 4, 2, 1);
  const Supervariables groups(grid.matrix, static_cast<int>(grid.matrix.rows()));
  const Matrix expected = nodes.matrix.cwiseAbs().cwiseSign(), graph(groups.graph(grid.matrix));
  TEST_EQUALITY((graph - Matrix(expected.triangularView<Eigen::Lower>())).norm(), 0.0);
}

TEUCHOS_UNIT_TEST(Supervariables, UnknownsThatAreAlikeBelowMayDifferAbove) {
  // 1 and 2 have the same rows below, and only 1 is coupled to 0.
  SparseMatrix matrix(4, 4);
  for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {2, 1}, {3, 1}, {2, 2}, {3, 2}, {3, 3}}) matrix.insert(i, j) = 1.0;
  matrix.makeCompressed();
  TEST_EQUALITY(Supervariables(matrix, 4).count(), 3);  // {0}, {1}, {2, 3}
}

TEUCHOS_UNIT_TEST(PermutedLower, IsTheTriangleOfThePermutedMatrix) {
  const NodeGrid grid(3, 3, 2, 2);
  const int n = static_cast<int>(grid.matrix.rows());
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = (7 * i + 3) % n;  // n is no multiple of 7
  const SparseMatrix lower = permutedLower(grid.matrix, order);
  const Matrix full(grid.matrix), expected = full(order, order);
  TEST_EQUALITY((Matrix(lower) - Matrix(expected.triangularView<Eigen::Lower>())).norm(), 0.0);
  for (int j = 0; j < n; ++j)
    TEST_ASSERT(std::is_sorted(lower.innerIndexPtr() + lower.outerIndexPtr()[j], lower.innerIndexPtr() + lower.outerIndexPtr()[j + 1]));
}

TEUCHOS_UNIT_TEST(Supervariables, AreOrderedByMetisIn3DOnly) {
  const NodeGrid plane(24, 24, 1, 2), space(8, 8, 8, 3);
  TEST_EQUALITY(CholmodFactor(plane.matrix).statistics().ordering, std::string("AMD"));
  const CholmodFactor factor(space.matrix);
  TEST_EQUALITY(factor.statistics().ordering, std::string("METIS"));
  CholmodOptions options;
  options.ordering = CholmodOptions::Ordering::Amd;
  TEST_COMPARE(factor.statistics().factorEntries, <, CholmodFactor(space.matrix, options).statistics().factorEntries);
  const Matrix x = Matrix::Random(space.matrix.rows(), 2);
  Matrix solved = space.matrix * x;
  factor.solve(solved);
  TEST_COMPARE((solved - x).norm(), <, 1e-12 * x.norm());
}

}  // namespace
}  // namespace suture
