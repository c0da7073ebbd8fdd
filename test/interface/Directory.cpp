#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/interface/Directory.hpp>

#include <Tpetra_Map.hpp>

#include <set>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(Directory, KeysAreNumberedOnceOverAllRanks) {
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

// Each rank sees its own id, its neighbour's, and one that all see.
TEUCHOS_UNIT_TEST(Directory, NumbersAreJoinedOverAllRanksThatSeeAnId) {
  const int rank = world()->getRank(), ranks = world()->getSize();
  const MapPtr seen = mapOf(world(), {1000, 10 * rank, 10 * ((rank + 1) % ranks), 10 * rank});
  const auto ids = seen->getNodeElementList();
  TEST_ASSERT(std::is_sorted(ids.begin(), ids.end()));
  TEST_EQUALITY(int(ids.size()), ranks == 1 ? 2 : 3);
  std::vector<std::vector<int>> mine(ids.size(), std::vector<int>{rank, 100});
  mine.back() = {200 + rank};
  const auto all = joinNumbers(seen, Tpetra::createOneToOne(seen), mine);
  for (int k = 0; k + 1 < int(ids.size()); ++k) {
    std::set<int> expected{100};
    for (int other = 0; other < ranks; ++other)
      if (10 * other == ids[k] || 10 * ((other + 1) % ranks) == ids[k]) expected.insert(other);
    TEST_ASSERT(std::equal(all[k].begin(), all[k].end(), expected.begin(), expected.end()));
  }
  TEST_EQUALITY(int(all.back().size()), ranks);
  TEST_EQUALITY(all.back().front(), 200);
}

// Each rank knows how its own unknown moves, and also sees its neighbour's.
TEUCHOS_UNIT_TEST(Directory, UnknownsAreThoseOfTheRanksThatKnowThem) {
  const int rank = world()->getRank(), ranks = world()->getSize();
  const auto unknownOf = [](int r) { return InterfaceLayout::Unknown{7 * r, {1.0 * r, 2, 3}, {0, 1.0 + r, 0}, {0, 0, 4.0 - r}, 0.5 * r}; };
  const MapPtr seen = mapOf(world(), {7 * rank, 7 * ((rank + 1) % ranks)});
  const auto found = joinUnknowns(seen, Tpetra::createOneToOne(seen), {unknownOf(rank)});
  TEST_EQUALITY(found.size(), std::size_t(ranks == 1 ? 1 : 2));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const InterfaceLayout::Unknown expected = unknownOf(int(seen->getGlobalElement(int(k)) / 7));
    TEST_EQUALITY(found[k].id, expected.id);
    TEST_ASSERT(found[k].point == expected.point);
    TEST_ASSERT(found[k].direction == expected.direction);
    TEST_ASSERT(found[k].moment == expected.moment);
    TEST_EQUALITY(found[k].flux, expected.flux);
  }
}

}  // namespace
}  // namespace suture
