#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <support/LinearComplementarity.hpp>

#include <random>

namespace suture {
namespace {

struct Numbers {
  std::mt19937 engine;
  std::normal_distribution<double> value;
  explicit Numbers(unsigned seed) : engine(seed) {}
  Matrix matrix(int rows, int columns) {
    Matrix a(rows, columns);
    for (double& x : a.reshaped()) x = value(engine);
    return a;
  }
};

/// Largest violation of z >= 0, w = m z + q >= 0, z.w = 0.
double violation(const Matrix& m, const Vector& q, const Vector& z) {
  const Vector w = m * z + q;
  const double size = std::max({1.0, z.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff()});
  return std::max({-z.minCoeff(), -w.minCoeff(), z.cwiseMin(w).maxCoeff()}) / size;
}

/// Solutions, by enumerating the 2^n sets of positive z.
int solutions(const Matrix& m, const Vector& q) {
  const int n = static_cast<int>(q.size());
  int found = 0;
  for (int set = 0; set < 1 << n; ++set) {
    Matrix a = Matrix::Identity(n, n);
    Vector b = Vector::Zero(n);
    for (int i = 0; i < n; ++i)
      if (set >> i & 1) a.row(i) = m.row(i), b(i) = -q(i);
    if (dense::rank(a) == n) found += violation(m, q, dense::solve(a, b)) < 1e-10;
  }
  return found;
}

TEUCHOS_UNIT_TEST(LinearComplementarity, FindsTheOneSolutionOfPositiveDefiniteMatrices) {
  Numbers numbers(3);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 1 + trial % 20;
    const Matrix a = numbers.matrix(n, n + 2), skew = numbers.matrix(n, n);
    // Not symmetric: it minimises no function.
    const Matrix m = a * a.transpose() + 0.3 * Matrix::Identity(n, n) + skew - skew.transpose();
    const Vector q = numbers.matrix(n, 1);
    const std::optional<Vector> z = linearComplementarity(m, q);
    TEST_ASSERT(z.has_value());
    if (!z) continue;
    TEST_COMPARE(violation(m, q, *z), <, 1e-9);
    if (n <= 8) TEST_EQUALITY(solutions(m, q), 1);
  }
}

// One contact point with friction: with a compliance that couples normal and tangent strongly it has a solution for any friction, although
// the matrix is not even positive semidefinite.
TEUCHOS_UNIT_TEST(LinearComplementarity, FindsASolutionOfContactWithAnyFriction) {
  Numbers numbers(4);
  int many = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double friction = trial % 7;
    const Matrix root = numbers.matrix(2, 2), compliance = root * root.transpose() + 0.01 * Matrix::Identity(2, 2);
    Matrix directions(2, 3);  // normal, along the tangent and back
    directions << 1, 0, 0, 0, 1, -1;
    Matrix m = Matrix::Zero(4, 4);
    m.topLeftCorner(3, 3) = directions.transpose() * compliance * directions;
    m.block(1, 3, 2, 1).setOnes();
    m.row(3) << friction, -1, -1, 0;
    Vector q(4);
    q << directions.transpose() * numbers.matrix(2, 1), 0.1 * (trial % 2);
    const std::optional<Vector> z = linearComplementarity(m, q);
    TEST_ASSERT(z.has_value());
    if (z) TEST_COMPARE(violation(m, q, *z), <, 1e-9);
    many += solutions(m, q) > 1;
  }
  TEST_COMPARE(many, >, 0);
}

TEUCHOS_UNIT_TEST(LinearComplementarity, IsEmptyWhereThereIsNoSolution) {
  const Matrix zero = Matrix::Zero(2, 2), identity = Matrix::Identity(2, 2);
  Vector q(2);
  q << 1.0, -1.0;
  TEST_ASSERT(!linearComplementarity(zero, q).has_value());
  TEST_ASSERT(!linearComplementarity(-identity, -Vector::Ones(2)).has_value());
  const std::optional<Vector> z = linearComplementarity(zero, Vector::Ones(2));  // nothing to do
  TEST_ASSERT(z.has_value() && z->isZero());
  TEST_ASSERT(linearComplementarity(Matrix(0, 0), Vector()).has_value());
}

// Steps of zero length: many right-hand sides are zero, some rows are duplicates.
TEUCHOS_UNIT_TEST(LinearComplementarity, DoesNotGoRoundWhereValuesTie) {
  Numbers numbers(5);
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 12;
    const Matrix half = numbers.matrix(6, 4);
    Matrix a(n, 4);
    a << half, half;
    Vector q = Vector::Zero(n);
    for (int i = 0; i < 2; ++i) q(i) = q(i + 6) = -std::abs(numbers.value(numbers.engine));
    const Matrix m = a * a.transpose() + Matrix::Ones(n, n);
    const std::optional<Vector> z = linearComplementarity(m, q);
    TEST_ASSERT(z.has_value());
    if (z) TEST_COMPARE(violation(m, q, *z), <, 1e-8);
  }
}

}  // namespace
}  // namespace suture
