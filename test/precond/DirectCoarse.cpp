#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <precond/CoarseElementsOf.hpp>
#include <suture/base/Errors.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

namespace suture {
namespace {

using namespace blocks;

/// Springs between numbers, distributed over the ranks; the first is tied to the ground unless the chain floats.
struct Springs {
  int size = 30;
  std::vector<CoarseElement> mine;
  Matrix dense = Matrix::Zero(30, 30);

  explicit Springs(bool floats) {
    int at = 0;
    for (int i = 0; i < size; ++i)
      for (int step : {1, 7})
        if (i + step < size) add(at++, i, i + step, std::pow(10.0, i % 5));
    if (!floats)
      for (int rank = 0; rank < world()->getSize(); ++rank) {  // a position to which every rank adds
        dense(0, 0) += 2.0;
        if (rank == world()->getRank()) mine.push_back({at + rank, {0}, Matrix::Constant(1, 1, 2.0)});
      }
  }
  CoarseParts parts() const { return {world(), namesIn(mine), size}; }
  void add(int number, int i, int j, double k) {
    const Matrix spring = k * (Matrix(2, 2) << 1.0, -1.0, -1.0, 1.0).finished();
    dense({i, j}, {i, j}) += spring;
    if (number % world()->getSize() == world()->getRank()) mine.push_back({number, {i, j}, spring});
  }
};

TEUCHOS_UNIT_TEST(DirectCoarse, SolvesAsADenseSystemWithAnyNumberOfCopies) {
  const Springs springs(false);
  for (const int copies : {0, 1, 2, 3, 100})
    for (const std::string solver : {"CHOLMOD", "Amesos2"}) {
      const DirectCoarse system(world(), springs.size, springs.mine, localSolver(solver)(), copies, false);
      TEST_EQUALITY(system.size(), springs.size);
      for (unsigned seed : {1u, 2u}) {  // twice: a factor is reused
        const Vector mine = random(int(springs.parts().names.size()), 1, 10 * seed + world()->getRank()).col(0);
        const Vector expected = solve(springs.dense, springs.parts().sum(mine));
        TEST_COMPARE(difference(system.solve(mine), expected(springs.parts().names)), <, 1e-10);  // on every rank
      }
    }
}

TEUCHOS_UNIT_TEST(DirectCoarse, ADependentSystemIsSolvedUpToItsNullSpace) {
  const Springs springs(true);
  const CoarseParts parts = springs.parts();
  Vector mine = random(int(parts.names.size()), 1, 3 + world()->getRank()).col(0);
  mine.array() -= mine.mean();  // in the range
  const Vector sum = parts.sum(mine);
  for (const int copies : {0, 1, 2}) {
    const DirectCoarse system(world(), springs.size, springs.mine, localSolver()(), copies, true);
    TEST_COMPARE(difference(springs.dense * parts.joined(system.solve(mine)), sum), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(DirectCoarse, RefusesIndefiniteMatricesOnAllRanks) {
  Springs springs(false);
  if (world()->getRank() == 0) springs.mine.push_back({1000, {4}, Matrix::Constant(1, 1, -1e7)});
  for (const int copies : {0, 1, 2})
    TEST_THROW(DirectCoarse(world(), springs.size, springs.mine, localSolver()(), copies, false), NumericalError);
}

TEUCHOS_UNIT_TEST(DirectCoarse, MayBeEmpty) {
  const DirectCoarse system(world(), 0, {}, localSolver()(), 0, false);
  TEST_EQUALITY(system.solve(Vector(0)).size(), 0);
}

}  // namespace
}  // namespace suture
