#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/PackedColumns.hpp>

#include <cmath>
#include <limits>

namespace suture {
namespace {

using Precision = PackedColumns::Precision;

const std::vector<std::pair<int, int>> shapes{{1, 1}, {7, 3}, {8, 4}, {15, 5}, {16, 8}, {17, 9}, {100, 31}, {250, 1}};

Vector transposed(const PackedColumns& packed, const Vector& x) {
  Vector y = Vector::Constant(3, 7.0);  // earlier values of y must not matter
  packed.multiplyTransposed(x, y);
  return y;
}

// Largest difference relative to the sum of magnitudes of an entry of A x.
double productError(const Matrix& a, const Vector& x, const Vector& y) {
  return ((y - a * x).array().abs() / (a.cwiseAbs() * x.cwiseAbs()).array()).maxCoeff();
}

TEUCHOS_UNIT_TEST(PackedColumns, MultipliesFromEitherSide) {
  for (const auto& [rows, columns] : shapes)
    for (const auto& [precision, rounding] : {std::pair(Precision::Double, 1e-14), std::pair(Precision::Single, 1e-5)}) {
      const Matrix a = Matrix::Random(rows, columns);
      const PackedColumns packed(a, precision);
      TEST_EQUALITY(packed.rows(), rows);
      TEST_EQUALITY(packed.columns(), columns);
      TEST_COMPARE((packed.full() - a).norm(), <=, precision == Precision::Double ? 0.0 : 1e-7 * a.norm());
      for (int times = 0; times < 2; ++times) {  // nothing is left from one product to the next
        const Vector x = Vector::Random(rows), c = Vector::Random(columns), before = Vector::Random(rows);
        TEST_COMPARE(productError(a.transpose(), x, transposed(packed, x)), <, rounding);
        Vector y = before;
        packed.addProduct(c, y);
        TEST_COMPARE(productError(a, c, y - before), <, rounding + 1e-15 / (a.cwiseAbs() * c.cwiseAbs()).minCoeff());
      }
    }
}

TEUCHOS_UNIT_TEST(PackedColumns, OfNothingIsNothing) {
  for (const auto& [rows, columns] : {std::pair(0, 0), std::pair(5, 0), std::pair(0, 3)}) {
    const PackedColumns packed(Matrix(rows, columns));
    TEST_ASSERT(transposed(packed, Vector::Ones(rows)) == Vector::Zero(columns));
    Vector y = Vector::Ones(rows);
    packed.addProduct(Vector::Ones(columns), y);
    TEST_ASSERT(y == Vector::Ones(rows));
    TEST_EQUALITY(packed.bytes(), 0.0);
  }
}

TEUCHOS_UNIT_TEST(PackedColumns, InSinglePrecisionTakesVectorsOfAnySize) {
  const Matrix a = Matrix::Random(40, 6);
  const PackedColumns packed(a, Precision::Single);
  TEST_EQUALITY(2.0 * packed.bytes(), PackedColumns(Matrix::Random(48, 6)).bytes());  // lines of 16 numbers, panels of 4 columns
  const Vector x = Vector::Random(40), c = Vector::Random(6);
  for (const double scale : {1e-200, 1e-3, 1e200}) {
    Vector y = Vector::Zero(40);
    packed.addProduct(scale * c, y);
    TEST_COMPARE((transposed(packed, scale * x) / scale - a.transpose() * x).norm(), <=, 1e-5 * a.norm() * x.norm());
    TEST_COMPARE((y / scale - a * c).norm(), <=, 1e-5 * a.norm() * c.norm());
  }
  TEST_EQUALITY(transposed(packed, Vector::Zero(40)).norm(), 0.0);
  Vector broken = x;
  broken(7) = std::numeric_limits<double>::quiet_NaN();
  TEST_ASSERT(transposed(packed, broken).array().isNaN().all());
  TEST_COMPARE((transposed(packed, x) - a.transpose() * x).norm(), <=, 1e-5 * a.norm() * x.norm());  // and is not kept
}

}  // namespace
}  // namespace suture
