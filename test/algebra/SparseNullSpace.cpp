#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <random>

namespace suture {
namespace {

SparseMatrix sparse(const Matrix& dense) { return dense.sparseView(); }

void compare(const Matrix& rows, Eigen::Index expected, bool& success, Teuchos::FancyOStream& out) {
  const Matrix found = sparseNullSpace(sparse(rows), 1e-9);
  TEST_EQUALITY(found.rows(), rows.cols());
  TEST_EQUALITY(found.cols(), expected);
  if (found.cols() == 0) return;
  if (rows.rows() > 0) TEST_COMPARE((rows * found).cwiseAbs().maxCoeff(), <, 1e-10);
  TEST_COMPARE(dense::difference(found.transpose() * found, Matrix::Identity(found.cols(), found.cols())), <, 1e-12);
}

TEUCHOS_UNIT_TEST(SparseNullSpace, HasTheDimensionOfSingularValues) {
  std::mt19937 random(3);
  std::normal_distribution<double> value;
  std::uniform_int_distribution<int> place(0, 39);
  for (int trial = 0; trial < 60; ++trial) {
    Matrix rows = Matrix::Zero(10 + trial, 40);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (int k = 0; k < 6; ++k) rows(i, place(random)) = value(random);
    // Rows that repeat others, and columns that depend on others.
    for (int k = 0; k < 4; ++k) rows.row(rows.rows() - 1 - k) = 0.5 * rows.row(k) - rows.row(k + 1);
    if (trial % 2 == 0) rows.col(39) = rows.col(3) - 2.0 * rows.col(8);
    if (trial % 3 == 0) rows.col(20).setZero();
    compare(rows, nullSpace(rows, 1e-9).cols(), success, out);
  }
}

// Blocks in a row, each joined to the next by two pairs with normals along x at the heights -1 and 1: each slides along y.
TEUCHOS_UNIT_TEST(SparseNullSpace, FindsTheMotionsOfBlocksInARow) {
  const int blocks = 50;
  Matrix rows = Matrix::Zero(2 * blocks, 3 * blocks);
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < 2; ++k) {
      const double height = k == 0 ? -1.0 : 1.0;
      rows(2 * b + k, 3 * b) = 1.0;
      rows(2 * b + k, 3 * b + 2) = -height;
      if (b == 0) continue;
      rows(2 * b + k, 3 * b - 3) = -1.0;
      rows(2 * b + k, 3 * b - 1) = height;
    }
  compare(rows, blocks, success, out);
  const Matrix found = sparseNullSpace(sparse(rows), 1e-9);
  for (int b = 0; b < blocks; ++b) {
    TEST_COMPARE(found.row(3 * b).norm() + found.row(3 * b + 2).norm(), <, 1e-10);
    TEST_FLOATING_EQUALITY(found.row(3 * b + 1).norm(), 1.0, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(SparseNullSpace, OfNoRowsIsTheWholeSpace) {
  compare(Matrix::Zero(0, 5), 5, success, out);
  compare(Matrix::Zero(3, 5), 5, success, out);
  compare(Matrix::Identity(5, 5), 0, success, out);
}

}  // namespace
}  // namespace suture
