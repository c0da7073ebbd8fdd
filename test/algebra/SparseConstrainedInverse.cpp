#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/algebra/SparseConstrainedInverse.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>

#include <algebra/SaddleProblem.hpp>

namespace suture {
namespace {

using namespace saddle;

/// Springs of different stiffness along the edges of a free grid. Its boundary consists of the nodes on two of its sides.
struct Springs {
  static constexpr int nx = 7, ny = 6;
  SparseMatrix stiffness{nx * ny, nx* ny};
  std::vector<int> boundary;

  Springs() {
    std::vector<Eigen::Triplet<double>> entries;
    const auto spring = [&](int a, int b, double k) {
      for (const int i : {a, b}) entries.emplace_back(i, i, k);
      entries.emplace_back(a, b, -k);
      entries.emplace_back(b, a, -k);
    };
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const int a = y * nx + x;
        if (x + 1 < nx) spring(a, a + 1, 1.0 + 0.1 * a);
        if (y + 1 < ny) spring(a, a + nx, 2.0 + 0.2 * (a % 5));
        if (x == 0 || y + 1 == ny) boundary.push_back(a);
      }
    stiffness.setFromTriplets(entries.begin(), entries.end());
  }
  Matrix schur() const {
    const std::vector<int> inside = complement(nx * ny, boundary);
    const Matrix ib(block(stiffness, inside, boundary)), ii(block(stiffness, inside, inside));
    return Matrix(block(stiffness, boundary, boundary)) - ib.transpose() * solvePositive(ii, ib);
  }
};

LocalSolverMaker cholmod() {
  return [] {
    Parameters own;
    own.set("Ordering", std::string("AMD"));
    return Registry<LocalSolver>::instance().make("CHOLMOD", own);
  };
}

// No single unknown is held in the last two cases: only the averages restrain the motion.
TEUCHOS_UNIT_TEST(SparseConstrainedInverse, IsTheDenseOne) {
  const Springs springs;
  const auto n = static_cast<int>(springs.boundary.size());
  for (const auto& [held, others] : {std::pair(2, 0), std::pair(2, 1), std::pair(2, 3), std::pair(0, 1), std::pair(0, 3)}) {
    Matrix c = Matrix::Zero(held + others, n);
    if (held > 0) c(0, 3) = 2.0, c(1 + others, n - 2) = 1.0;  // each of these two holds an unknown
    for (int k = 0; k < others; ++k)
      for (int j = 0; j < n; ++j)
        if (j % 3 == k) c(held / 2 + k, j) = 1.0 + 0.1 * j;
    const auto sparse = std::make_unique<SparseConstrainedInverse>(springs.stiffness, Matrix::Ones(springs.stiffness.rows(), 1),
                                                                   springs.boundary, c, cholmod(), "it");
    const ConstrainedInverse dense(springs.schur(), c, "it");
    const Matrix p = applied(*sparse, Matrix::Identity(n, n)), expected = applied(dense, Matrix::Identity(n, n));
    TEST_COMPARE((p - expected).norm(), <, 1e-12 * expected.norm());
    TEST_COMPARE((sparse->basis() - dense.basis()).norm(), <, 1e-12 * dense.basis().norm());
    TEST_COMPARE((sparse->energy() - dense.energy()).norm(), <=, 1e-12 * (dense.energy().norm() + springs.stiffness.norm()));
    TEST_COMPARE((c * sparse->basis() - Matrix::Identity(held + others, held + others)).norm(), <, 1e-12);
    Vector values, expectedValues, trace = Vector::Zero(n), expectedTrace = trace;
    const Vector flux = random(n, 1, 4).col(0);
    sparse->applyBasisTransposed(flux, values);
    dense.applyBasisTransposed(flux, expectedValues);
    TEST_COMPARE((values - expectedValues).norm(), <, 1e-12 * expectedValues.norm());
    sparse->addBasis(values, trace);
    dense.addBasis(expectedValues, expectedTrace);
    TEST_COMPARE((trace - expectedTrace).norm(), <, 1e-11 * expectedTrace.norm());
    Matrix both(n, 1), expectedBoth(n, 1);
    const Vector given = random(held + others, 1, 7).col(0);
    sparse->applyWithBasis(flux, values, given, both);
    dense.applyWithBasis(flux, expectedValues, given, expectedBoth);
    TEST_COMPARE((both - expectedBoth).norm(), <, 1e-11 * expectedBoth.norm());
    TEST_COMPARE((both - expected * flux - dense.basis() * given).norm(), <, 1e-11 * expectedBoth.norm());
  }
}

/// Springs along the edges of a cubic grid; its boundary consists of the nodes on its sides. Large enough for supernodes.
struct Cube {
  static constexpr int n = 13;
  SparseMatrix stiffness{n * n * n, n* n* n};
  std::vector<int> boundary;

  explicit Cube(double jump) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int a = 0; a < n * n * n; ++a) {
      const int x = a % n, y = a / n % n, z = a / n / n;
      const auto spring = [&](int b) {
        const double k = x < n / 2 ? 1.0 : jump;
        for (const int i : {a, b}) entries.emplace_back(i, i, k);
        entries.emplace_back(a, b, -k);
        entries.emplace_back(b, a, -k);
      };
      if (x + 1 < n) spring(a + 1);
      if (y + 1 < n) spring(a + n);
      if (z + 1 < n) spring(a + n * n);
      if (x == 0 || y == 0 || z == 0 || x + 1 == n || y + 1 == n || z + 1 == n) boundary.push_back(a);
    }
    stiffness.setFromTriplets(entries.begin(), entries.end());
  }
};

TEUCHOS_UNIT_TEST(SparseConstrainedInverse, IsKeptInSinglePrecisionWhereThatChangesLittle) {
  const Cube cube(1.0);
  const auto n = static_cast<int>(cube.boundary.size());
  Matrix c = Matrix::Zero(3, n);
  for (int k = 0; k < n; ++k) c(k % 3, k) = std::sqrt(3.0 / n);  // about unit length, as in BDDC
  const SparseConstrainedInverse inverse(cube.stiffness, Matrix::Ones(cube.stiffness.rows(), 1), cube.boundary, c, cholmod(), "it");
  TEST_COMPARE(inverse.bytesRead(), >, 0.0);  // known for factors in single precision only
  const Matrix f = random(n, 11, 5), x = applied(inverse, f);
  // The tolerance of the class: four digits.
  TEST_COMPARE((c * x).norm(), <, 2e-4 * x.norm());
  // K u - f is a force of the constraints on the trace and zero inside: u is the harmonic extension of x.
  const std::vector<int> inside = complement(static_cast<int>(cube.stiffness.rows()), cube.boundary);
  const Matrix ib(block(cube.stiffness, inside, cube.boundary)), ii(principalBlock(cube.stiffness, inside));
  const Matrix flux = Matrix(principalBlock(cube.stiffness, cube.boundary)) * x - ib.transpose() * solvePositive(ii, ib * x);
  const Matrix left = flux - f, force = c * left;
  TEST_COMPARE((left - c.transpose() * ((c * c.transpose()).inverse() * force)).norm(), <, 2e-4 * f.norm());
  // One by one, and all at once.
  for (int k = 0; k < f.cols(); ++k) TEST_COMPARE((applied(inverse, f.col(k)) - x.col(k)).norm(), <, 1e-4 * x.col(k).norm());
}

TEUCHOS_UNIT_TEST(SparseConstrainedInverse, IsKeptInDoublePrecisionWhereStiffnessJumps) {
  const Cube cube(1e4);
  const auto n = static_cast<int>(cube.boundary.size());
  Matrix c = Matrix::Zero(3, n);
  for (int k = 0; k < n; ++k) c(k % 3, k) = std::sqrt(3.0 / n);  // about unit length, as in BDDC
  const SparseConstrainedInverse inverse(cube.stiffness, Matrix::Ones(cube.stiffness.rows(), 1), cube.boundary, c, cholmod(), "it");
  TEST_EQUALITY(inverse.bytesRead(), 0.0);
  const Matrix x = applied(inverse, random(n, 1, 5));
  TEST_COMPARE((c * x).norm(), <, 1e-6 * x.norm());
}

TEUCHOS_UNIT_TEST(SparseConstrainedInverse, RefusesSystemsThatItCannotInvert) {
  const Springs springs;
  const auto n = static_cast<int>(springs.boundary.size());
  const Matrix translation = Matrix::Ones(springs.stiffness.rows(), 1);
  const auto make = [&](const Matrix& c) {
    SparseConstrainedInverse(springs.stiffness, translation, springs.boundary, c, cholmod(), "it");
  };
  Matrix difference = Matrix::Zero(1, n);  // does not fix the translation
  difference(0, 1) = 1.0, difference(0, 4) = -1.0;
  TEST_THROW(make(difference), NumericalError);
  Matrix twice = Matrix::Zero(3, n);
  twice(0, 2) = 1.0;
  twice.row(1).setOnes();
  twice.row(2).setConstant(2.0);
  TEST_THROW(make(twice), NumericalError);
  twice.row(1).setZero();
  twice(1, 2) = 3.0;
  TEST_THROW(make(twice), NumericalError);
}

}  // namespace
}  // namespace suture
