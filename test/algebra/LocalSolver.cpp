#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(LocalSolver, AllThatAreRegisteredGiveTheDenseAnswer) {
  const Scene scene = clampedSquare(1, 6, 3e9);
  const Blocks body(scene, alone(), 1);
  const SparseMatrix k = body.subdomains[0]->stiffness().full();
  const Matrix rhs = random(int(k.rows()), 5), expected = dense::solveSymmetric(Matrix(k), rhs);
  TEST_ASSERT(Registry<LocalSolver>::instance().has("CHOLMOD"));
  TEST_ASSERT(Registry<LocalSolver>::instance().has("Amesos2"));
  for (const std::string& name : Registry<LocalSolver>::instance().names()) {
    const auto solver = localSolver(name)();
    solver->factorise(k);
    Matrix x = rhs, one = rhs.col(2);
    solver->solve(x);
    solver->solve(one);
    TEST_COMPARE(difference(x, expected), <, 1e-10);
    TEST_COMPARE(difference(one, expected.col(2)), <, 1e-10);
    TEST_EQUALITY(solver->solves(), 6);
    Matrix wide = random(int(k.rows()) + 3, 7);  // a block of a larger matrix: its rows are not contiguous
    const Matrix before = wide;
    solver->solve(wide.block(2, 1, k.rows(), 4));
    TEST_COMPARE(difference(k * wide.block(2, 1, k.rows(), 4), before.block(2, 1, k.rows(), 4)), <, 1e-10);
    TEST_EQUALITY(difference(wide.topRows(2), before.topRows(2)), 0.0);
    TEST_EQUALITY(difference(wide.col(5), before.col(5)), 0.0);
  }
}

// Amesos2's KLU2 was silently wrong on matrices distributed over ranks: each rank must get the solution for its own matrix.
TEUCHOS_UNIT_TEST(LocalSolver, EveryRankSolvesItsOwnMatrix) {
  const int rank = world()->getRank();
  const Scene scene = clampedSquare(1, 5 + rank, 1.0 + rank);
  const Blocks body(scene, alone(), 1);
  const SparseMatrix k = body.subdomains[0]->stiffness().full();
  const Matrix rhs = random(int(k.rows()), 3, 7 + rank), expected = dense::solveSymmetric(Matrix(k), rhs);
  for (const std::string& name : Registry<LocalSolver>::instance().names()) {
    const auto solver = localSolver(name)();
    for (int time = 0; time < 2; ++time) {  // factorise() discards the previous factor
      solver->factorise(time == 0 ? SparseMatrix(2.0 * k) : k);
      Matrix x = rhs;
      solver->solve(x);
      TEST_COMPARE(difference(x, time == 0 ? Matrix(0.5 * expected) : expected), <, 1e-11);
    }
  }
}

TEUCHOS_UNIT_TEST(LocalSolver, RefusesAnIndefiniteMatrixOrTheWrongLength) {
  SparseMatrix indefinite(3, 3);
  for (int i = 0; i < 3; ++i) indefinite.insert(i, i) = i - 1.5;
  TEST_THROW(localSolver("CHOLMOD")()->factorise(indefinite), NumericalError);
  for (const std::string& name : Registry<LocalSolver>::instance().names()) {
    SparseMatrix singular(3, 3);
    singular.insert(0, 0) = 1.0;
    singular.insert(1, 1) = 0.0;
    singular.insert(2, 2) = 1.0;
    const auto solver = localSolver(name)();
    TEST_THROW(solver->factorise(singular), NumericalError);
    SparseMatrix unit(3, 3);
    unit.setIdentity();
    solver->factorise(unit);
    Matrix longer = Matrix::Ones(4, 1);
    TEST_THROW(solver->solve(longer), InternalError);
  }
  TEST_THROW(Registry<LocalSolver>::instance().make("CHOLMUD", Parameters()), InputError);
}

}  // namespace
}  // namespace suture
