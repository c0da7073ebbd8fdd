// Predictions against CHOLMOD's counts on grids.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/CostModel.hpp>

#include <cmath>

namespace suture {
namespace {

/// Lower triangle of a matrix with the displacement graph of cells^dimension square or cubic elements.
Eigen::SparseMatrix<double> grid(int dimension, int cells) {
  const int side = cells + 1, layers = dimension == 3 ? side : 1, reach = dimension == 3 ? 1 : 0;
  std::vector<Eigen::Triplet<double>> entries;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int dz = -reach; dz <= reach; ++dz)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const int u = x + dx, v = y + dy, w = z + dz;
              if (u < 0 || v < 0 || w < 0 || u >= side || v >= side || w >= layers) continue;
              const int a = (z * side + y) * side + x, b = (w * side + v) * side + u;
              for (int i = 0; i < dimension; ++i)
                for (int j = 0; j < dimension; ++j)
                  if (const int row = a * dimension + i, column = b * dimension + j; row >= column)
                    entries.emplace_back(row, column, row == column ? 30.0 * dimension : -0.5);
            }
  Eigen::SparseMatrix<double> matrix(side * side * layers * dimension, side * side * layers * dimension);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEUCHOS_UNIT_TEST(CostModel, PredictsFactorsWithinAThird) {
  for (const auto& [dimension, cells] : {std::pair(2, 20), std::pair(2, 40), std::pair(2, 60), std::pair(2, 120), std::pair(3, 6),
                                         std::pair(3, 8), std::pair(3, 10), std::pair(3, 13)}) {
    const Eigen::SparseMatrix<double> matrix = grid(dimension, cells);
    CholmodOptions options;
    options.ordering = dimension == 3 ? CholmodOptions::Ordering::Metis : CholmodOptions::Ordering::Amd;
    const CholmodFactor factor(matrix, options);
    const CostModel cost(dimension);
    const auto n = static_cast<double>(matrix.rows());
    const double entries = cost.factorEntries(n) / factor.statistics().factorEntries,
                 flops = cost.factorFlops(n) / factor.statistics().flops;
    out << dimension << "D, " << n << " unknowns: entries " << entries << ", operations " << flops << " of what was counted\n";
    TEST_COMPARE(entries, >, 2.0 / 3.0);
    TEST_COMPARE(entries, <, 1.52);
    TEST_COMPARE(flops, >, 2.0 / 3.0);
    TEST_COMPARE(flops, <, 1.52);
  }
}

// In 2D a dense inverse is cheaper than a factor for subdomains of usual size; in 3D the factor is cheaper from a few thousand unknowns.
TEUCHOS_UNIT_TEST(CostModel, KnowsWhereDenseMatricesPay) {
  const auto ratio = [](int dimension, double cells) {
    const CostModel cost(dimension);
    const double n = dimension * std::pow(cells + 1, dimension), b = dimension * 2.0 * dimension * std::pow(cells + 1, dimension - 1);
    return (cost.denseSeconds(b) + 40 * cost.productSeconds(b)) /
           (cost.factorFlops(n) / CostModel::kFactorRate + 40 * cost.solveSeconds(n));
  };
  TEST_COMPARE(ratio(2, 60), <, 0.3);
  TEST_COMPARE(ratio(3, 40), >, 1.0);
}

}  // namespace
}  // namespace suture
