#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/SerialSection.hpp>
#include <suture/algebra/elimination/StaticCondensation.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

#include <omp.h>

#include <numeric>

namespace suture {
namespace {

using namespace blocks;

// A held square of n x n cells whose stiffness jumps by `jump` in every other cell, its last unknowns ordered last.
SparseMatrix gridMatrix(int n, double jump, std::vector<Point>* places = nullptr) {
  Scene scene = blocks::square(1, n, 1.0);
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  const Blocks all(scene, alone());
  SparseMatrix k = all.subdomains[0]->stiffness().full();
  if (places) *places = placesOfDofs(*all.subdomains[0]);
  // D K D is definite if K is, and as badly scaled as stiffness with jumps.
  for (int j = 0; j < k.cols(); ++j)
    for (SparseMatrix::InnerIterator it(k, j); it; ++it) it.valueRef() *= (it.row() % 3 ? 1.0 : jump) * (j % 3 ? 1.0 : jump);
  return k;
}

TEUCHOS_UNIT_TEST(SingleFactor, SolvesToTheAccuracyOfADoubleOne) {
  for (const double jump : {1.0, 1e3, 1e5})
    for (const int trailing : {0, 40}) {
      std::vector<Point> places;
      const SparseMatrix k = gridMatrix(12, jump, &places);
      const int n = static_cast<int>(k.rows()), leading = n - trailing;
      CholmodOptions options;
      options.form = CholmodOptions::Form::Supernodal;
      options.trailing = trailing;
      const CholmodFactor whole(k, options);
      std::vector<int> last(trailing);
      std::iota(last.begin(), last.end(), leading);
      StaticCondensation condensation(SymmetricMatrix(k), Vector::Zero(n), last, places);
      const SingleFactor& factor = condensation.factor();
      Vector x = random(n, 1, 3).col(0);
      Matrix expected = x.head(leading);
      whole.solveLeading(expected);
      const Vector b = x;
      factor.solve(SymmetricMatrix(k), x);
      TEST_EQUALITY(x.tail(trailing).norm(), 0.0);
      const Vector residual = (b - k * x).head(leading);
      const Vector terms = (k.cwiseAbs() * x.cwiseAbs()).head(leading);  // scale of the residual's round-off
      TEST_COMPARE(residual.norm(), <, 1e-13 * terms.norm() + 1e-12 * b.head(leading).norm());
      TEST_COMPARE((x.head(leading) - expected.col(0)).norm(), <, 1e-9 * expected.norm());
      TEST_COMPARE(factor.bytes(), <, 0.55 * whole.statistics().bytes);
    }
}

TEUCHOS_UNIT_TEST(SingleFactor, OfNothingLeavesNothing) {
  const SparseMatrix k = gridMatrix(3, 1.0);
  Vector x = random(static_cast<int>(k.rows()), 1).col(0);
  SingleFactor().solve(SymmetricMatrix(k), x);
  TEST_EQUALITY(x.norm(), 0.0);
}

TEUCHOS_UNIT_TEST(SerialSection, LeavesThreadsAsTheyWere) {
  const int before = omp_get_max_active_levels();
  {
    const SerialSection alone;
    TEST_EQUALITY(omp_get_max_active_levels(), 0);
    const SerialSection within;
    TEST_EQUALITY(omp_get_max_active_levels(), 0);
  }
  TEST_EQUALITY(omp_get_max_active_levels(), before);
}

}  // namespace
}  // namespace suture
