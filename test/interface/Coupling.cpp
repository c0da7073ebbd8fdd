#include <Teuchos_UnitTestHarness.hpp>
#include <suture/interface/Coupling.hpp>

namespace suture {
namespace {

Matrix denseOf(const Coupling& coupling, int unknowns) {
  Matrix r(coupling.rows(), unknowns);
  coupling.restrictTo(Matrix::Identity(unknowns, unknowns), r);
  return r;
}

TEUCHOS_UNIT_TEST(Coupling, OfColumnsPicksUnknowns) {
  const Coupling coupling({4, 0, 2});
  TEST_EQUALITY(coupling.rows(), 3);
  Matrix expected = Matrix::Zero(3, 5);
  expected(0, 4) = expected(1, 0) = expected(2, 2) = 1;
  TEST_EQUALITY((denseOf(coupling, 5) - expected).norm(), 0.0);
}

TEUCHOS_UNIT_TEST(Coupling, AddsWithTheTransposeOfWhatItRestricts) {
  for (const Coupling& coupling : {Coupling({4, 0, 2}), Coupling({2, 2, 2})}) {
    Matrix transposed = Matrix::Zero(5, 3);
    coupling.addTransposed(Matrix::Identity(3, 3), transposed);
    TEST_EQUALITY((transposed - denseOf(coupling, 5).transpose()).norm(), 0.0);
    coupling.addTransposed(Matrix::Identity(3, 3), transposed);  // adds
    TEST_EQUALITY((transposed - 2 * denseOf(coupling, 5).transpose()).norm(), 0.0);
  }
}

}  // namespace
}  // namespace suture
