#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/interface/Coupling.hpp>

namespace suture {
namespace {

Matrix denseOf(const Coupling& coupling, int unknowns) {
  Matrix r(coupling.rows(), unknowns);
  coupling.restrictTo(Matrix::Identity(unknowns, unknowns), r);
  return r;
}

TEUCHOS_UNIT_TEST(Coupling, OfColumnsPicksUnknowns) {
  const Coupling coupling(std::vector<int>{4, 0, 2});
  TEST_ASSERT(coupling.boolean());
  TEST_EQUALITY(coupling.rows(), 3);
  Matrix expected = Matrix::Zero(3, 5);
  expected(0, 4) = expected(1, 0) = expected(2, 2) = 1;
  TEST_EQUALITY((denseOf(coupling, 5) - expected).norm(), 0.0);
}

TEUCHOS_UNIT_TEST(Coupling, OfRowsCombinesUnknowns) {
  const Coupling coupling({0, 2, 2, 3}, {1, 3, 0}, {0.5, -2.0, 3.0}, Vector::LinSpaced(3, 1, 3));
  TEST_ASSERT(!coupling.boolean());
  TEST_EQUALITY(coupling.rows(), 3);
  Matrix expected = Matrix::Zero(3, 4);
  expected(0, 1) = 0.5;
  expected(0, 3) = -2.0;
  expected(2, 0) = 3.0;
  TEST_EQUALITY((denseOf(coupling, 4) - expected).norm(), 0.0);
  TEST_EQUALITY(coupling.shift()(2), 3.0);
}

TEUCHOS_UNIT_TEST(Coupling, AddsWithTheTransposeOfWhatItRestricts) {
  for (const Coupling& coupling : {Coupling(std::vector<int>{4, 0, 2}), Coupling({0, 2, 2, 3}, {1, 3, 0}, {0.5, -2.0, 3.0}),
                                   Coupling({0, 1, 2, 3}, {2, 2, 2}, {1, 1, 1})}) {
    Matrix transposed = Matrix::Zero(5, 3);
    coupling.addTransposed(Matrix::Identity(3, 3), transposed);
    TEST_EQUALITY((transposed - denseOf(coupling, 5).transpose()).norm(), 0.0);
    coupling.addTransposed(Matrix::Identity(3, 3), transposed);  // adds
    TEST_EQUALITY((transposed - 2 * denseOf(coupling, 5).transpose()).norm(), 0.0);
  }
}

TEUCHOS_UNIT_TEST(Coupling, RefusesRowsThatDoNotFitTogether) {
  TEST_THROW(Coupling({0, 2}, {1}, {1.0}), InternalError);
  TEST_THROW(Coupling({0, 1}, {1}, {1.0, 2.0}), InternalError);
  TEST_THROW(Coupling({0, 1}, {1}, {1.0}, Vector::Zero(2)), InternalError);
  TEST_NOTHROW(Coupling({0, 1}, {1}, {1.0}, Vector::Zero(1)));
}

}  // namespace
}  // namespace suture
