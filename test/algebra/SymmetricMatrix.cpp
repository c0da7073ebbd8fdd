#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/SymmetricMatrix.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace suture {
namespace {

// Each entry exists with the given probability, including diagonal entries.
SparseMatrix sparse(int n, double density, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0), chance(0.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) {
      if (chance(generator) > density) continue;
      const double value = uniform(generator);
      entries.emplace_back(i, j, value);
      if (i != j) entries.emplace_back(j, i, value);
    }
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEUCHOS_UNIT_TEST(SymmetricMatrix, ReturnsTheMatrixItWasMadeOf) {
  for (const double density : {0.0, 0.1, 0.5, 1.0})
    for (const int n : {0, 1, 2, 17}) {
      const SparseMatrix both = sparse(n, density, 7);
      const SymmetricMatrix kept(both);
      TEST_EQUALITY(kept.rows(), n);
      TEST_EQUALITY(kept.nonZeros(), both.nonZeros());
      const SparseMatrix full = kept.full();
      TEST_ASSERT(full.isCompressed());
      TEST_EQUALITY(full.nonZeros(), both.nonZeros());
      TEST_ASSERT(std::equal(both.outerIndexPtr(), both.outerIndexPtr() + n + 1, full.outerIndexPtr()));
      TEST_ASSERT(std::equal(both.innerIndexPtr(), both.innerIndexPtr() + both.nonZeros(), full.innerIndexPtr()));
      TEST_ASSERT(std::equal(both.valuePtr(), both.valuePtr() + both.nonZeros(), full.valuePtr()));
      TEST_ASSERT(kept.dense() == Matrix(both));
      TEST_ASSERT(kept.diagonal() == Vector(Matrix(both).diagonal()));
    }
}

TEUCHOS_UNIT_TEST(SymmetricMatrix, KeepsHalfOfTheEntries) {
  const SparseMatrix both = sparse(30, 0.4, 3);
  const SymmetricMatrix kept(both);
  TEST_EQUALITY(2 * kept.lower().nonZeros(), both.nonZeros() + (Matrix(both).diagonal().array() != 0.0).count());
  for (int j = 0; j < kept.lower().cols(); ++j)
    for (SparseMatrix::InnerIterator it(kept.lower(), j); it; ++it) TEST_COMPARE(it.row(), >=, j);
}

TEUCHOS_UNIT_TEST(SymmetricMatrix, MultipliesVectorsAndSeveral) {
  const SparseMatrix both = sparse(25, 0.3, 5);
  const SymmetricMatrix kept(both);
  const Matrix x = Matrix::Random(25, 3);
  const double scale = Matrix(both).norm() * x.norm();
  TEST_COMPARE((kept * x - both * x).norm(), <, 1e-14 * scale);
  const Vector one = kept * x.col(1);
  TEST_COMPARE((one - both * x.col(1)).norm(), <, 1e-14 * scale);
}

TEUCHOS_UNIT_TEST(SymmetricMatrix, DoesNotReadAboveTheDiagonal) {
  SparseMatrix both = sparse(9, 1.0, 11);
  const Matrix expected(both);
  for (int j = 0; j < 9; ++j)
    for (SparseMatrix::InnerIterator it(both, j); it && it.row() < j; ++it) it.valueRef() = std::nan("");
  TEST_ASSERT(SymmetricMatrix(both).dense() == expected);
}

}  // namespace
}  // namespace suture
