#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Errors.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <set>

namespace suture {
namespace {

using namespace blocks;

/// Springs between numbers, dealt out to the ranks; the first is tied to the ground unless it floats.
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
      for (int rank = 0; rank < world()->getSize(); ++rank) {  // a place to which every rank adds
        dense(0, 0) += 2.0;
        if (rank == world()->getRank()) mine.push_back({at + rank, {0}, Matrix::Constant(1, 1, 2.0)});
      }
  }
  void add(int number, int i, int j, double k) {
    const Matrix spring = k * (Matrix(2, 2) << 1.0, -1.0, -1.0, 1.0).finished();
    dense({i, j}, {i, j}) += spring;
    if (number % world()->getSize() == world()->getRank()) mine.push_back({number, {i, j}, spring});
  }
};

Vector sumOver(const Vector& mine) {
  Vector sum(mine.size());
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), sum.data());
  return sum;
}

TEUCHOS_UNIT_TEST(DirectCoarse, SolvesAsADenseSystemWithAnyNumberOfCopies) {
  const Springs springs(false);
  for (const int copies : {0, 1, 2, 3, 100})
    for (const std::string solver : {"CHOLMOD", "Amesos2"}) {
      const DirectCoarse system(world(), springs.size, springs.mine, localSolver(solver)(), copies, false);
      TEST_EQUALITY(system.size(), springs.size);
      for (unsigned seed : {1u, 2u}) {  // twice: a factor serves more than once
        const Vector mine = random(springs.size, 1, 10 * seed + world()->getRank()).col(0);
        const Vector expected = solve(springs.dense, sumOver(mine));
        TEST_COMPARE(difference(system.solve(mine), expected), <, 1e-10);  // on every rank
      }
    }
}

TEUCHOS_UNIT_TEST(DirectCoarse, ADependentSystemIsSolvedButForItsNullSpace) {
  const Springs springs(true);
  Vector mine = random(springs.size, 1, 3 + world()->getRank()).col(0);
  mine.array() -= mine.mean();  // in the range
  const Vector sum = sumOver(mine);
  for (const int copies : {0, 1, 2}) {
    const DirectCoarse system(world(), springs.size, springs.mine, localSolver()(), copies, true);
    TEST_COMPARE(difference(springs.dense * system.solve(mine), sum), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(DirectCoarse, RefusesWhatIsNotPositiveDefiniteOnAllRanks) {
  Springs springs(false);
  if (world()->getRank() == 0) springs.mine.push_back({1000, {4}, Matrix::Constant(1, 1, -1e7)});
  for (const int copies : {0, 1, 2})
    TEST_THROW(DirectCoarse(world(), springs.size, springs.mine, localSolver()(), copies, false), NumericalError);
}

TEUCHOS_UNIT_TEST(DirectCoarse, MayBeEmpty) {
  const DirectCoarse system(world(), 0, {}, localSolver()(), 0, false);
  TEST_EQUALITY(system.solve(Vector(0)).size(), 0);
}

TEUCHOS_UNIT_TEST(DirectCoarse, KeysAreNumberedOnceOverAllRanks) {
  const int rank = world()->getRank(), ranks = world()->getSize();
  // ranks share a key with their neighbour, all share one; one is given twice
  const std::vector<GlobalId> keys{1000000000000LL, 50LL * rank, 50LL * (rank + 1), 50LL * rank};
  int count = 0;
  const std::vector<int> numbers = numberKeys(world(), keys, count);
  TEST_EQUALITY(count, ranks + 2);
  TEST_EQUALITY(numbers.size(), keys.size());
  TEST_EQUALITY(numbers[1], numbers[3]);
  // the same key has the same number everywhere, and every number is used
  std::vector<int> table(ranks + 2, 0), all(ranks + 2);
  table[0] = rank == 0 ? numbers[0] + 1 : 0;
  table[1 + rank] = numbers[1] + 1;
  if (rank == ranks - 1) table[ranks + 1] = numbers[2] + 1;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, ranks + 2, table.data(), all.data());
  TEST_EQUALITY(numbers[0] + 1, all[0]);
  TEST_EQUALITY(numbers[2] + 1, all[2 + rank]);
  TEST_EQUALITY(std::set<int>(all.begin(), all.end()).size(), std::size_t(ranks + 2));
  TEST_EQUALITY(*std::min_element(all.begin(), all.end()), 1);
  TEST_EQUALITY(*std::max_element(all.begin(), all.end()), ranks + 2);
  TEST_ASSERT(numberKeys(world(), {}, count).empty());
  TEST_EQUALITY(count, 0);
}

}  // namespace
}  // namespace suture
