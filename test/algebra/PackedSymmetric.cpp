#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/PackedSymmetric.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace suture {
namespace {

using Precision = PackedSymmetric::Precision;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<int> sizes{0, 1, 2, 31, 32, 33, 64, 100, 250};  // around the width of a panel, and several of them

Matrix symmetric(int size) {
  const Matrix any = Matrix::Random(size, size);
  return any + any.transpose();
}

Matrix product(const PackedSymmetric& packed, const Matrix& x) {
  Matrix y = Matrix::Constant(x.rows(), x.cols(), nan);  // earlier values of y must not matter
  packed.multiply(x, y);
  return y;
}

// Largest difference relative to the sum of magnitudes of an entry of A x.
double productError(const Matrix& a, const Matrix& x, const Matrix& y) {
  if (y.size() == 0) return 0.0;
  return ((y - a * x).array().abs() / (a.cwiseAbs() * x.cwiseAbs()).array()).maxCoeff();
}

TEUCHOS_UNIT_TEST(PackedSymmetric, MultipliesLikeAFullMatrix) {
  for (const int size : sizes) {
    const Matrix a = symmetric(size), x = Matrix::Random(size, 3);
    TEST_COMPARE(productError(a, x, product(PackedSymmetric(a), x)), <, 1e-14);
    TEST_COMPARE(productError(a, x, product(PackedSymmetric(a, Precision::Single), x)), <, 1e-5);
  }
}

TEUCHOS_UNIT_TEST(PackedSymmetric, TreatsEachRightHandSideAlone) {
  for (const int size : sizes)
    for (const Precision precision : {Precision::Double, Precision::Single}) {
      const PackedSymmetric packed(symmetric(size), precision);
      Matrix x = Matrix::Random(size, 3);
      x.col(2) = 2 * x.col(0) - 0.5 * x.col(1);
      const Matrix y = product(packed, x);
      for (int c = 0; c < 3; ++c) TEST_ASSERT(y.col(c) == product(packed, x.col(c)));
      const double rounding = precision == Precision::Double ? 1e-14 : 1e-5;
      TEST_COMPARE((y.col(2) - 2 * y.col(0) + 0.5 * y.col(1)).norm(), <=, rounding * size * y.norm());
    }
}

TEUCHOS_UNIT_TEST(PackedSymmetric, ReadsTheLowerTriangleOnly) {
  for (const int size : sizes) {
    const Matrix a = symmetric(size);
    Matrix lower = a;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(nan);
    TEST_ASSERT(PackedSymmetric(lower).full() == a);
    TEST_EQUALITY(PackedSymmetric(lower).size(), size);
    TEST_COMPARE((PackedSymmetric(lower, Precision::Single).full() - a).norm(), <=, 1e-7 * a.norm());
  }
}

TEUCHOS_UNIT_TEST(PackedSymmetric, GivesABlockInTheOrderAskedFor) {
  const Matrix a = symmetric(100);
  const std::vector<int> positions{70, 3, 99, 32, 31};
  TEST_ASSERT(PackedSymmetric(a).block(positions) == Matrix(a(positions, positions)));
  TEST_EQUALITY(PackedSymmetric(a).block({}).size(), 0);
}

TEUCHOS_UNIT_TEST(PackedSymmetric, KeepsLittleMoreThanATriangle) {
  for (const int size : sizes) {
    const double triangle = size * (size + 1) / 2.0, bytes = PackedSymmetric(symmetric(size)).bytes();
    TEST_COMPARE(bytes, >=, sizeof(double) * triangle);
    TEST_COMPARE(bytes, <=, sizeof(double) * (triangle + 16.0 * size));  // the other halves of the diagonal blocks
    TEST_EQUALITY(PackedSymmetric(symmetric(size), Precision::Single).bytes(), bytes / 2);
  }
}

TEUCHOS_UNIT_TEST(PackedSymmetric, InSinglePrecisionTakesVectorsOfAnySize) {
  const Matrix a = symmetric(40), x = Matrix::Random(40, 1);
  const PackedSymmetric packed(a, Precision::Single);
  for (const double scale : {1e-200, 1e-3, 1e200}) TEST_COMPARE(productError(a, scale * x, product(packed, scale * x)), <, 1e-5);
  TEST_ASSERT(product(packed, Matrix::Zero(40, 1)) == Matrix::Zero(40, 1));
  Matrix broken = x;
  broken(7, 0) = nan;
  TEST_ASSERT(product(packed, broken).array().isNaN().all());
}

}  // namespace
}  // namespace suture
