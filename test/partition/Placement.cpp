#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <suture/partition/cut/Placement.hpp>

using suture::placeOnRanks;

TEUCHOS_UNIT_TEST(Placement, BalancesByWeight) {
  // Largest first: 9 | 8 | 7, then 6 to the third, 5 to the second, 4 to the first: 13 each.
  TEST_ASSERT(placeOnRanks({4, 5, 6, 7, 8, 9}, 3) == (std::vector<int>{0, 1, 2, 2, 1, 0}));
}

TEUCHOS_UNIT_TEST(Placement, KeepsNeighboursTogetherWhereThatBalances) {
  TEST_ASSERT(placeOnRanks({5, 5, 5, 5, 5, 5, 5, 5}, 2) == (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
  TEST_ASSERT(placeOnRanks({300, 301, 299, 300, 300, 300}, 3) == (std::vector<int>{0, 0, 1, 1, 2, 2}));
  TEST_ASSERT(placeOnRanks({2, 2, 3, 1}, 2) == (std::vector<int>{0, 0, 1, 1}));
  TEST_ASSERT(placeOnRanks({3, 3, 1, 1}, 2) == (std::vector<int>{0, 1, 0, 1}));  // in order: 3 and 5
  TEST_ASSERT(placeOnRanks({7}, 4) == (std::vector<int>{0}));
}

TEUCHOS_UNIT_TEST(Placement, LeavesRanksEmptyWhenThereAreFewUnits) {
  const std::vector<int> ranks = placeOnRanks({5, 5}, 4);
  TEST_ASSERT(ranks == (std::vector<int>{0, 1}));
  TEST_ASSERT(placeOnRanks({}, 3).empty());
}

TEUCHOS_UNIT_TEST(Placement, StaysWithinGrahamsBound) {
  // Longest processing time first: at most 4/3 - 1/(3 ranks) of the best, and the best is at least the mean and the largest.
  std::vector<long long> weights;
  for (int i = 0; i < 200; ++i) weights.push_back(1 + (i * 7919) % 997);
  for (int ranks : {2, 3, 8, 31}) {
    const std::vector<int> rankOf = placeOnRanks(weights, ranks);
    std::vector<double> load(ranks, 0);
    double total = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      load[rankOf[i]] += weights[i];
      total += weights[i];
    }
    TEST_COMPARE(*std::max_element(load.begin(), load.end()), <=, (4. / 3 - 1. / (3 * ranks)) * std::max(total / ranks, 997.0) + 1);
  }
}
