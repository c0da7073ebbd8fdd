#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/base/Errors.hpp>

#include <algebra/SaddleProblem.hpp>

namespace suture {
namespace {

using namespace saddle;

TEUCHOS_UNIT_TEST(ConstrainedInverse, IsTheSaddleProblemsSolution) {
  // A large inverse and its basis are kept in single precision if the condition allows it; with a large jump they are not.
  struct Case {
    int n, kernel;
    double orders, rounding, exact;  // exact = 0: elimination itself is not exact
  };
  for (const auto& [n, kernel, orders, rounding, exact] :
       {Case{14, 0, 4.0, 1e-10, 1e-10}, Case{14, 1, 4.0, 1e-10, 1e-10}, Case{14, 3, 4.0, 1e-10, 1e-10}, Case{210, 1, 0.0, 1e-6, 1e-9},
        Case{210, 1, 7.0, 1e-11, 0.0}}) {
    const Matrix c = rows(n);
    const Matrix s = semidefinite(n, kernel, orders);
    const ConstrainedInverse found(s, c, "it");
    const Matrix p = applied(found, Matrix::Identity(n, n));
    if (exact > 0.0) {
      const Saddle expected(s, c);
      TEST_COMPARE((p - expected.inverse).norm(), <, rounding * expected.inverse.norm());
      TEST_COMPARE((found.basis() - expected.basis).norm(), <, rounding * expected.basis.norm());
      TEST_COMPARE((found.energy() - expected.energy).norm(), <, exact * s.norm());
    }
    const double kept = rounding > 1e-7 ? rounding : 1e-12;  // accuracy of single precision, where it is used
    TEST_COMPARE((p - p.transpose()).norm(), <, kept * p.norm());
    // The class's claims, as it states them.
    TEST_COMPARE((c * found.basis() - Matrix::Identity(5, 5)).norm(), <, kept);
    TEST_COMPARE((c * p).norm(), <, rounding * c.norm() * p.norm());
    TEST_COMPARE((found.basis().transpose() * s * found.basis() - found.energy()).norm(), <, std::max(1e-10, kept) * s.norm());
  }
}

// P S with P in single precision, as conjugate gradients apply it: as close to the identity as the condition permits.
TEUCHOS_UNIT_TEST(ConstrainedInverse, InSinglePrecisionItIsAlmostTheInverse) {
  const int n = 210;
  const Matrix q = dense::orthogonal(random(n, n, 5));
  for (const auto& [condition, nearness] : {std::pair(1e1, 1e-5), std::pair(1e3, 1e-4), std::pair(1e4, 1e-3)}) {
    Vector values(n);
    for (int i = 0; i < n; ++i) values(i) = 1e11 * std::pow(condition, -i / (n - 1.0));
    const Matrix s = q * values.asDiagonal() * q.transpose();
    const ConstrainedInverse found(s, Matrix(0, n), "it");
    const double bytes = PackedSymmetric(s, PackedSymmetric::Precision::Single).bytes();
    TEST_EQUALITY(found.bytesRead(), bytes);
    const Vector eigenvalues = dense::eigenvaluesOfProduct(applied(found, Matrix::Identity(n, n)), s);
    TEST_COMPARE(eigenvalues.minCoeff(), >, 1.0 - nearness);
    TEST_COMPARE(eigenvalues.maxCoeff(), <, 1.0 + nearness);
  }
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, AppliesToSeveralFluxesAtOnce) {
  const int n = 14;
  const ConstrainedInverse inverse(semidefinite(n, 2), rows(n), "it");
  const Matrix flux = random(n, 3, 8), all = applied(inverse, flux);
  for (int k = 0; k < 3; ++k) TEST_COMPARE((all.col(k) - applied(inverse, flux.col(k))).norm(), <, 1e-14 * all.norm());
}

TEUCHOS_UNIT_TEST(LocalInverse, MultipliesByTheBasisThatItIsGiven) {
  Given given;
  const Vector flux = random(4, 1, 1).col(0), coefficients = random(2, 1, 2).col(0);
  Vector values = Vector::Ones(7), trace = flux;
  given.applyBasisTransposed(flux, values);
  TEST_EQUALITY(values.size(), 0);
  given.addBasis(values, trace);
  TEST_ASSERT(trace == flux);
  given.phi = random(4, 2, 3);
  given.applyBasisTransposed(flux, values);
  TEST_COMPARE((values - given.phi.transpose() * flux).norm(), <, 1e-15 * given.phi.norm() * flux.norm());
  given.addBasis(coefficients, trace);
  TEST_COMPARE((trace - flux - given.phi * coefficients).norm(), <, 1e-15 * (flux.norm() + given.phi.norm() * coefficients.norm()));
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, DoesNotDependOnTheOrderOfItsRows) {
  const int n = 14;
  const Matrix s = semidefinite(n, 3), c = rows(n), reversed = c.colwise().reverse();
  const ConstrainedInverse one(s, c, "it"), other(s, reversed, "it");
  const Matrix unit = Matrix::Identity(n, n);
  TEST_COMPARE((applied(one, unit) - applied(other, unit)).norm(), <, 1e-10 * applied(one, unit).norm());
  TEST_COMPARE((one.basis() - other.basis().rowwise().reverse()).norm(), <, 1e-10 * one.basis().norm());
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, WithAllUnknownsPrimalNothingIsLeftToInvert) {
  const int n = 6;
  const Matrix s = semidefinite(n, 2), c = random(n, n, 4) + 2.0 * Matrix::Identity(n, n);
  const ConstrainedInverse found(s, c, "it");
  TEST_EQUALITY(applied(found, Matrix::Identity(n, n)).norm(), 0.0);
  TEST_COMPARE((found.basis() * c - Matrix::Identity(n, n)).norm(), <, 1e-12 * c.norm());
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, WithoutRowsItIsTheInverse) {
  const Matrix s = semidefinite(8, 0);
  const ConstrainedInverse found(s, Matrix(0, 8), "it");
  TEST_COMPARE((s * applied(found, Matrix::Identity(8, 8)) - Matrix::Identity(8, 8)).norm(), <, 1e-8);
  TEST_EQUALITY(found.basis().cols(), 0);
  TEST_EQUALITY(found.energy().size(), 0);
}

std::string messageOf(const Matrix& s, const Matrix& c) {
  try {
    ConstrainedInverse(s, c, "subdomain 'left 3'");
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "accepted";
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, RefusesAMechanismAndNamesItsProblem) {
  const int n = 14;
  const Matrix s = semidefinite(n, 3);
  const std::string message = messageOf(s, rows(n).topRows(2));  // two rows hold no kernel of three dimensions
  TEST_ASSERT(message.find("subdomain 'left 3'") != std::string::npos);
  TEST_ASSERT(message.find("mechanism") != std::string::npos);
  TEST_EQUALITY(messageOf(s, rows(n).topRows(3)), "accepted");
}

TEUCHOS_UNIT_TEST(ConstrainedInverse, RefusesRowsThatFollowFromOthers) {
  const int n = 14;
  const Matrix s = semidefinite(n, 3), c = rows(n);
  Matrix dependent(6, n);
  dependent << c, 2.0 * c.row(0) - c.row(1) + 0.5 * c.row(4);
  const std::string message = messageOf(s, dependent);
  TEST_ASSERT(message.find("subdomain 'left 3'") != std::string::npos);
  TEST_ASSERT(message.find("depends linearly on the others") != std::string::npos);
}

}  // namespace
}  // namespace suture
