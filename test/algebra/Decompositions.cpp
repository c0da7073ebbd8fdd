#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <cmath>

using namespace suture;

namespace {

/// A matrix with given singular values: a rotated diagonal matrix.
Matrix withValues(const Vector& values, int rows) {
  Matrix m = Matrix::Zero(rows, values.size());
  for (int i = 0; i < values.size(); ++i) m(i, i) = values(i);
  const auto rotate = [](Matrix& x, int i, int j, double angle) {
    const Eigen::RowVectorXd a = x.row(i), b = x.row(j);
    x.row(i) = std::cos(angle) * a - std::sin(angle) * b;
    x.row(j) = std::sin(angle) * a + std::cos(angle) * b;
  };
  for (int i = 0; i + 1 < rows; ++i) rotate(m, i, i + 1, 0.3 + i);
  Matrix t = m.transpose();
  for (int i = 0; i + 1 < t.rows(); ++i) rotate(t, i, i + 1, 0.7 + i);
  return t.transpose();
}

}  // namespace

TEUCHOS_UNIT_TEST(Decompositions, SingularValuesAreThoseTheMatrixWasMadeOf) {
  for (const int rows : {3, 7}) {
    const Vector values = Eigen::Vector3d(5.0, 2.0, 1e-7);
    const Matrix m = withValues(values, rows);
    const SingularValues svd = singularValues(m);
    for (int i = 0; i < 3; ++i) TEST_FLOATING_EQUALITY(svd.values(i), values(i), 1e-8);
    TEST_COMPARE((svd.u * svd.values.asDiagonal() * svd.v.transpose() - m).norm(), <, 1e-14);
    TEST_COMPARE((svd.u.transpose() * svd.u - Matrix::Identity(3, 3)).norm(), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(Decompositions, NullSpaceOfAWideMatrixIsOrthogonalToItsRows) {
  const Matrix rows = withValues(Eigen::Vector2d(1.0, 3.0), 5).transpose();  // 2 x 5
  const Matrix z = nullSpace(rows);
  TEST_EQUALITY(z.cols(), 3);
  TEST_COMPARE((rows * z).norm(), <, 1e-14);
  TEST_COMPARE((z.transpose() * z - Matrix::Identity(3, 3)).norm(), <, 1e-14);
}

TEUCHOS_UNIT_TEST(Decompositions, NullSpaceCountsValuesBelowTheThresholdAsZero) {
  const Matrix m = withValues(Eigen::Vector3d(1.0, 1e-9, 1e-11), 6);
  TEST_EQUALITY(nullSpace(m).cols(), 1);
  TEST_EQUALITY(nullSpace(m, 1e-8).cols(), 2);
}

TEUCHOS_UNIT_TEST(Decompositions, OrthonormalBasisLeavesOutDependentColumns) {
  Matrix m = withValues(Eigen::Vector3d(4.0, 3.0, 2.0), 6);
  m.col(2) = m.col(0) - 2.0 * m.col(1);
  const Matrix q = orthonormalBasis(m, 1e-10);
  TEST_EQUALITY(q.cols(), 2);
  TEST_COMPARE((q.transpose() * q - Matrix::Identity(2, 2)).norm(), <, 1e-14);
  TEST_COMPARE((m - q * (q.transpose() * m)).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(Decompositions, PivotRowsDetermineTheColumns) {
  Matrix m = Matrix::Zero(6, 2);
  m(1, 0) = 1e-3;
  m(3, 0) = 2.0;
  m(4, 1) = 5.0;
  const std::vector<int> rows = pivotRows(m);
  TEST_EQUALITY(rows.size(), 2u);
  TEST_EQUALITY(rows[0], 4);
  TEST_EQUALITY(rows[1], 3);
}

TEUCHOS_UNIT_TEST(Decompositions, LeastSquaresLeavesAResidualOrthogonalToTheColumns) {
  const Matrix a = withValues(Eigen::Vector3d(4.0, 3.0, 2.0), 6);
  const Vector b = Vector::LinSpaced(6, -1.0, 2.0);
  TEST_COMPARE((a.transpose() * (a * leastSquares(a, b) - b)).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(Decompositions, TridiagonalEigenvaluesOfTheSecondDifferenceAreKnown) {
  const int n = 8;
  const std::vector<double> values = tridiagonalEigenvalues(std::vector<double>(n, 2.0), std::vector<double>(n - 1, -1.0));
  for (int k = 0; k < n; ++k) TEST_FLOATING_EQUALITY(values[k], 2.0 - 2.0 * std::cos((k + 1) * M_PI / (n + 1)), 1e-12);
}

TEUCHOS_UNIT_TEST(Decompositions, CholeskyFactorRefusesAnIndefiniteMatrix) {
  Matrix m(2, 2), lower;
  m << 4.0, 2.0, 2.0, 5.0;
  TEST_ASSERT(choleskyFactor(m, lower));
  TEST_COMPARE((lower * lower.transpose() - m).norm(), <, 1e-15);
  m(1, 1) = 0.5;
  TEST_ASSERT(!choleskyFactor(m, lower));
}

TEUCHOS_UNIT_TEST(Decompositions, EigenpairsOfASymmetricMatrix) {
  const Matrix half = withValues(Eigen::Vector3d(3.0, 2.0, 1.0), 3);
  const Eigenpairs pairs = symmetricEigenpairs(half * half.transpose());
  for (int i = 0; i < 3; ++i) TEST_FLOATING_EQUALITY(pairs.values(i), (i + 1.0) * (i + 1.0), 1e-12);
  TEST_COMPARE((half * half.transpose() * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), <, 1e-13);
}
