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

/// Springs along the edges of a grid, of different stiffness: nothing holds it. Its boundary are the nodes on two of its sides.
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

// Nothing holds an unknown alone in the last two cases: the motion is left to the averages.
TEUCHOS_UNIT_TEST(SparseConstrainedInverse, IsTheDenseOne) {
  const Springs springs;
  const auto n = static_cast<int>(springs.boundary.size());
  for (const auto& [held, others] : {std::pair(2, 0), std::pair(2, 1), std::pair(2, 3), std::pair(0, 1), std::pair(0, 3)}) {
    Matrix c = Matrix::Zero(held + others, n);
    if (held > 0) c(0, 3) = 2.0, c(1 + others, n - 2) = 1.0;  // these two hold an unknown each
    for (int k = 0; k < others; ++k)
      for (int j = 0; j < n; ++j)
        if (j % 3 == k) c(held / 2 + k, j) = 1.0 + 0.1 * j;
    const auto sparse = std::make_unique<SparseConstrainedInverse>(springs.stiffness, Matrix::Ones(springs.stiffness.rows(), 1),
                                                                   springs.boundary, c, cholmod(), "it");
    const ConstrainedInverse dense(springs.schur(), c, "it");
    const Matrix p = applied(*sparse, Matrix::Identity(n, n)), expected = applied(dense, Matrix::Identity(n, n));
    TEST_COMPARE((p - expected).norm(), <, 1e-12 * expected.norm());
    TEST_COMPARE((sparse->basis() - dense.basis()).norm(), <, 1e-12 * dense.basis().norm());
    TEST_COMPARE((sparse->energy() - dense.energy()).norm(), <=, 1e-12 * dense.energy().norm());
    TEST_COMPARE((c * sparse->basis() - Matrix::Identity(held + others, held + others)).norm(), <, 1e-12);
    Vector values, expectedValues, trace = Vector::Zero(n), expectedTrace = trace;
    const Vector flux = random(n, 1, 4).col(0);
    sparse->applyBasisTransposed(flux, values);
    dense.applyBasisTransposed(flux, expectedValues);
    TEST_COMPARE((values - expectedValues).norm(), <, 1e-12 * expectedValues.norm());
    sparse->addBasis(values, trace);
    dense.addBasis(expectedValues, expectedTrace);
    TEST_COMPARE((trace - expectedTrace).norm(), <, 1e-11 * expectedTrace.norm());
  }
}

TEUCHOS_UNIT_TEST(SparseConstrainedInverse, SaysWhereItIsNot) {
  const Springs springs;
  const auto n = static_cast<int>(springs.boundary.size());
  const Matrix translation = Matrix::Ones(springs.stiffness.rows(), 1);
  const auto make = [&](const Matrix& c) {
    SparseConstrainedInverse(springs.stiffness, translation, springs.boundary, c, cholmod(), "it");
  };
  Matrix difference = Matrix::Zero(1, n);  // tells nothing of the translation
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
