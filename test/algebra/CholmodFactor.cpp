#include <Teuchos_UnitTestHarness.hpp>
#include <support/Matrices.hpp>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/base/Errors.hpp>

#include <omp.h>

#include <Eigen/Dense>
#include <filesystem>

namespace suture {
namespace {

using namespace matrices;
using Form = CholmodOptions::Form;
using Ordering = CholmodOptions::Ordering;

std::vector<CholmodOptions> everyWay(int trailing) {
  std::vector<CholmodOptions> all;
  for (Ordering ordering : {Ordering::Amd, Ordering::ConstrainedAmd, Ordering::Metis})
    for (Form form : {Form::Automatic, Form::Simplicial, Form::Supernodal}) {
      CholmodOptions options;
      options.ordering = ordering;
      options.form = form;
      options.trailing = trailing;
      all.push_back(options);
    }
  return all;
}

TEUCHOS_UNIT_TEST(CholmodFactor, StartsNoThreads) {
  const std::filesystem::path threads = "/proc/self/task";  // Linux; elsewhere not measurable
  if (!std::filesystem::exists(threads)) return;
  const auto count = [&] { return std::distance(std::filesystem::directory_iterator(threads), {}); };
  omp_set_num_threads(4);  // the caller's setting
  CholmodOptions options;
  options.form = Form::Supernodal;
  options.trailing = 150;
  options.shift = Vector::Constant(150, 24.0);
  const auto before = count();
  const CholmodFactor factor(floatingBody(40, 40), options);
  TEST_EQUALITY(count(), before);
  omp_set_num_threads(1);
}

TEUCHOS_UNIT_TEST(CholmodFactor, SolvesLikeADenseFactorisation) {
  const Sparse a = randomDefinite(150, 7);
  const Matrix dense(a), rhs = Matrix::Random(150, 37);  // more columns than one pass through L takes
  const Matrix expected = dense::solveSymmetric(dense, rhs);
  for (int trailing : {0, 31, 150})
    for (const CholmodOptions& options : everyWay(trailing)) {
      const CholmodFactor factor(a, options);
      Matrix x = rhs;
      factor.solve(x);
      TEST_COMPARE(difference(x, expected), <, 1e-13);
      Matrix one = rhs.col(3);
      factor.solve(one);
      TEST_COMPARE(difference(one, expected.col(3)), <, 1e-13);
    }
}

TEUCHOS_UNIT_TEST(CholmodFactor, ReadsTheLowerTriangleOnly) {
  const Sparse a = randomDefinite(60, 3), lower = a.triangularView<Eigen::Lower>();
  Matrix x = Matrix::Random(60, 2), y = x;
  CholmodFactor(a).solve(x);
  CholmodFactor(lower).solve(y);
  TEST_EQUALITY(difference(x, y), 0.0);
}

TEUCHOS_UNIT_TEST(CholmodFactor, SolvesWithTheLeadingBlock) {
  const Sparse a = randomDefinite(150, 11);
  const int trailing = 40, leading = 110;
  const Matrix rhs = Matrix::Random(leading, 5);
  const Matrix expected = dense::solveSymmetric(Matrix(a).topLeftCorner(leading, leading), rhs);
  for (const CholmodOptions& options : everyWay(trailing)) {
    const CholmodFactor factor(a, options);
    Matrix x = rhs, one = rhs.col(1);
    factor.solveLeading(x);
    factor.solveLeading(one);
    TEST_COMPARE(difference(x, expected), <, 1e-13);
    TEST_COMPARE(difference(one, expected.col(1)), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(CholmodFactor, SchurComplementIsTheDenseOne) {
  const Sparse a = randomDefinite(120, 5);
  for (int trailing : {1, 25, 120})
    for (CholmodOptions options : everyWay(trailing)) {
      TEST_COMPARE(difference(CholmodFactor(a, options).trailingSchur(), denseSchur(Matrix(a), trailing)), <, 1e-13);
      options.shift = CholmodFactor::trailingDiagonal(a, trailing);
      TEST_COMPARE(difference(CholmodFactor(a, options).trailingSchur(), denseSchur(Matrix(a), trailing)), <, 1e-13);
    }
}

TEUCHOS_UNIT_TEST(CholmodFactor, SchurComplementOfAFloatingBodyHasTheTranslationsInItsKernel) {
  const int nx = 16, ny = 20, trailing = 2 * (nx + 1);  // the upper edge
  const Sparse a = floatingBody(nx, ny);
  for (CholmodOptions options : everyWay(trailing)) {
    options.shift = CholmodFactor::trailingDiagonal(a, trailing);
    const Matrix s = CholmodFactor(a, options).trailingSchur();
    for (int k = 0; k < 2; ++k) {
      Vector z = Vector::Zero(trailing);
      for (int i = k; i < trailing; i += 2) z[i] = 1;
      TEST_COMPARE((s * z).cwiseAbs().maxCoeff(), <, 1e-14 * (s.cwiseAbs() * z).maxCoeff());
    }
    // only the three rigid motions have no energy
    const Vector values = dense::eigenvalues(s);
    TEST_COMPARE(values[2], <, 1e-13 * values[trailing - 1]);
    TEST_COMPARE(values[3], >, 1e-3 * values[trailing - 1]);
  }
}

TEUCHOS_UNIT_TEST(CholmodFactor, RefusesASingularMatrix) {
  for (const CholmodOptions& options : everyWay(10)) TEST_THROW(CholmodFactor(floatingBody(12, 9), options), NumericalError);
  Sparse indefinite = randomDefinite(30, 2);
  indefinite.coeffRef(17, 17) = -1;
  TEST_THROW(CholmodFactor{indefinite}, NumericalError);
}

TEUCHOS_UNIT_TEST(CholmodFactor, RefusesSizesThatDoNotFit) {
  const Sparse a = randomDefinite(20, 1);
  CholmodOptions options;
  options.trailing = 21;
  TEST_THROW(CholmodFactor(a, options), InternalError);
  options.trailing = 4;
  options.shift = Vector::Ones(3);
  TEST_THROW(CholmodFactor(a, options), InternalError);
  Matrix rhs = Matrix::Ones(19, 1);
  TEST_THROW(CholmodFactor(a).solve(rhs), InternalError);
}

TEUCHOS_UNIT_TEST(CholmodFactor, CountsItsWork) {
  const int n = 30;
  Sparse diagonal(n, n);
  diagonal.setIdentity();
  const CholmodFactor factor(diagonal);
  TEST_EQUALITY(factor.statistics().factorEntries, double(n));
  TEST_EQUALITY(factor.statistics().smallestPivot, 1.0);
  TEST_EQUALITY(factor.statistics().ordering, std::string("AMD"));
  // a full matrix: n (n + 1) / 2 entries in any order
  const Sparse full = Matrix(Matrix::Ones(n, n) + n * Matrix::Identity(n, n)).sparseView();
  TEST_EQUALITY(CholmodFactor(full).statistics().factorEntries, n * (n + 1) / 2.0);
}

}  // namespace
}  // namespace suture
