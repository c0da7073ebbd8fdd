// Inverses updated to other constraints, against a new solution of the saddle problem.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/algebra/UpdatedInverse.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <algebra/SaddleProblem.hpp>

namespace suture {
namespace {

using namespace saddle;

// The constraints after a change of rows(n): row k is row from[k] of it, or a new one.
Matrix changed(int n, const std::vector<int>& from) {
  const Matrix old = rows(n), others = random(int(from.size()), n, 11);
  Matrix c(from.size(), n);
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (from[k] >= 0)
      c.row(int(k)) = old.row(from[k]);
    else
      c.row(int(k)) = others.row(int(k));
  }
  return c;
}

std::shared_ptr<const LocalInverse> base(int n, int kernel, double orders = 4.0) {
  return std::make_shared<ConstrainedInverse>(semidefinite(n, kernel, orders), rows(n), "it");
}

TEUCHOS_UNIT_TEST(UpdatedInverse, IsTheSaddleProblemsSolution) {
  struct Case {
    int n, kernel;
    double orders, rounding;  // the last one is kept in single precision
  };
  const std::vector<std::vector<int>> changes{{0, 1, 2, 3, 4},                               // unchanged
                                              {4, 2, 0, 1, 3},                               // reordered
                                              {0, 1, 2, 4},        {0, 2, 4},                // fewer
                                              {0, 1, 2, 3, 4, -1}, {-1, 0, 1, -1, 2, 3, 4},  // more
                                              {0, 1, 2, -1, 4},    {-1, 4, 2, -1, 0, -1}};   // both
  for (const auto& [n, kernel, orders, rounding] :
       {Case{14, 0, 1.0, 1e-10}, Case{14, 1, 1.0, 1e-10}, Case{14, 3, 1.0, 1e-10}, Case{210, 1, 0.0, 1e-5}})
    for (const std::vector<int>& from : changes) {
      const Matrix c = changed(n, from);
      const auto found = UpdatedInverse::make(base(n, kernel, orders), from, c);
      TEST_ASSERT(found != nullptr);
      if (!found) continue;
      const Matrix s = semidefinite(n, kernel, orders);
      const Saddle expected(s, c);
      const Matrix p = applied(*found, Matrix::Identity(n, n));
      TEST_COMPARE((p - expected.inverse).norm(), <, rounding * expected.inverse.norm());
      TEST_COMPARE((found->basis() - expected.basis).norm(), <, rounding * expected.basis.norm());
      TEST_COMPARE((found->energy() - expected.energy).norm(), <, rounding * s.norm());
      // products with the basis are those of the matrix
      const Vector flux = random(n, 1, 1).col(0), coefficients = random(int(from.size()), 1, 2).col(0);
      Vector values, trace = flux;
      found->applyBasisTransposed(flux, values);
      TEST_COMPARE((values - found->basis().transpose() * flux).norm(), <, 1e-13 * found->basis().norm() * flux.norm());
      found->addBasis(coefficients, trace);
      TEST_COMPARE((trace - flux - found->basis() * coefficients).norm(), <, 1e-13 * found->basis().norm() * coefficients.norm());
      // the base's inverse and its updates, but not its basis
      const auto kept = static_cast<int>(std::count_if(from.begin(), from.end(), [](int row) { return row >= 0; }));
      TEST_EQUALITY(found->bytesRead() > base(n, kernel, orders)->bytesRead(), kept < 5 || from.size() > 5);
      TEST_COMPARE(found->basisBytesRead(), >, 0.0);
    }
}

// A new row that stops a nearly free motion cancels its compliance, with the digits of a base in single precision.
TEUCHOS_UNIT_TEST(UpdatedInverse, IsRefusedWhereANewRowStopsASoftMotion) {
  const int n = 210;
  const Matrix motion = nullSpace(semidefinite(n, 1, 0.0), 1e-9);
  TEST_EQUALITY(motion.cols(), 1);
  const Matrix old = rows(n) - rows(n) * motion * motion.transpose();  // leaves the motion to its spring
  Matrix c(old.rows() + 1, n);
  c << old, motion.transpose();
  std::vector<int> from;
  for (int k = 0; k < old.rows(); ++k) from.push_back(k);
  from.push_back(-1);
  for (const double spring : {1.0, 1e-2, 1e-8}) {
    const Matrix s = semidefinite(n, 1, 0.0) + spring * motion * motion.transpose();
    const auto found = UpdatedInverse::make(std::make_shared<ConstrainedInverse>(s, old, "it"), from, c);
    TEST_EQUALITY(found != nullptr, spring > 1e-3);
    if (!found) continue;
    const Saddle expected(s, c);
    TEST_COMPARE((applied(*found, Matrix::Identity(n, n)) - expected.inverse).norm(), <, 1e-3 * expected.inverse.norm());
  }
}

TEUCHOS_UNIT_TEST(UpdatedInverse, OfAnUpdateIsOneToo) {
  const int n = 14;
  const std::vector<int> first{0, 1, 2, -1, 4}, second{3, 0, 1, -1, 2};
  const Matrix c = changed(n, first);
  Matrix d(5, n);
  d << c.row(3), c.row(0), c.row(1), random(1, n, 23), c.row(2);
  const std::shared_ptr<const LocalInverse> once = UpdatedInverse::make(base(n, 1, 1.0), first, c);
  const auto twice = UpdatedInverse::make(once, second, d);
  const Saddle expected(semidefinite(n, 1, 1.0), d);
  TEST_COMPARE((applied(*twice, Matrix::Identity(n, n)) - expected.inverse).norm(), <, 1e-10 * expected.inverse.norm());
}

TEUCHOS_UNIT_TEST(UpdatedInverse, IsTheBaseForTheSameRowsInTheSameOrderOnly) {
  const int n = 14;
  const auto first = base(n, 1, 1.0);
  TEST_ASSERT(inverseUnder(first, 5, {0, 1, 2, 3, 4}, changed(n, {0, 1, 2, 3, 4})) == first);
  for (const std::vector<int>& from : {std::vector<int>{4, 2, 0, 1, 3}, {0, 1, 2, 3}, {0, 1, 2, 3, 4, -1}}) {
    const Matrix c = changed(n, from);
    const auto found = inverseUnder(first, 5, from, c);
    TEST_ASSERT(found != nullptr && found != first);
    if (found) TEST_COMPARE((found->basis() - Saddle(semidefinite(n, 1, 1.0), c).basis).norm(), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(UpdatedInverse, IsRefusedWhereItWouldBeInaccurate) {
  const int n = 14;
  // two rows hold no kernel of dimension three
  TEST_ASSERT(UpdatedInverse::make(base(n, 3, 1.0), {0, 3}, changed(n, {0, 3})) == nullptr);
  TEST_ASSERT(UpdatedInverse::make(base(n, 1, 1.0), {}, Matrix(0, n)) == nullptr);
  // a new row that depends on others: of the base, of a new one
  Matrix c = changed(n, {0, 1, 2, 3, 4, -1});
  c.row(5) = c.row(1) - 2.0 * c.row(3);
  TEST_ASSERT(UpdatedInverse::make(base(n, 1, 1.0), {0, 1, 2, 3, 4, -1}, c) == nullptr);
  Matrix d = changed(n, {0, 1, 2, 3, 4, -1, -1});
  d.row(6) = d.row(5) + 1e-9 * d.row(0);
  TEST_ASSERT(UpdatedInverse::make(base(n, 1, 1.0), {0, 1, 2, 3, 4, -1, -1}, d) == nullptr);
  // the same in single precision, which leaves more round-off
  Matrix large = changed(210, {0, 1, 2, 3, 4, -1});
  large.row(5) = large.row(1) - 2.0 * large.row(3);
  TEST_ASSERT(UpdatedInverse::make(base(210, 1, 0.0), {0, 1, 2, 3, 4, -1}, large) == nullptr);
  large.row(5) += 0.1 * random(1, 210, 6);
  TEST_ASSERT(UpdatedInverse::make(base(210, 1, 0.0), {0, 1, 2, 3, 4, -1}, large) != nullptr);
  // a user's inverse that provides no energies
  const auto given = std::make_shared<Given>();
  given->phi = random(n, 2, 3);
  TEST_ASSERT(UpdatedInverse::make(given, {0, 1}, random(2, n, 4)) == nullptr);
}

TEUCHOS_UNIT_TEST(UpdatedInverse, AppliesToSeveralFluxesAtOnce) {
  const int n = 14;
  const std::vector<int> from{-1, 4, 2, -1, 0};
  const auto inverse = UpdatedInverse::make(base(n, 1, 1.0), from, changed(n, from));
  const Matrix flux = random(n, 3, 8), all = applied(*inverse, flux);
  for (int k = 0; k < 3; ++k) TEST_COMPARE((all.col(k) - applied(*inverse, flux.col(k))).norm(), <, 1e-14 * all.norm());
}

}  // namespace
}  // namespace suture
