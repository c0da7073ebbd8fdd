#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <suture/partition/cut/Placement.hpp>

using suture::placeInRuns;
using suture::placeOnRanks;

namespace {

std::vector<long long> loadsOf(const std::vector<long long>& weights, const std::vector<int>& rankOf, int ranks) {
  std::vector<long long> loads(ranks, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) loads[rankOf[i]] += weights[i];
  return loads;
}

// Least possible largest load of runs, by trying all places of the cuts.
long long leastLargest(const std::vector<long long>& weights, std::size_t first, int ranks) {
  long long load = 0, best = -1;
  for (std::size_t end = first; end <= weights.size(); ++end) {
    if (end > first) load += weights[end - 1];
    if (ranks == 1 && end < weights.size()) continue;
    const long long rest = ranks == 1 ? 0 : leastLargest(weights, end, ranks - 1), largest = std::max(load, rest);
    if (best < 0 || largest < best) best = largest;
  }
  return best;
}

}  // namespace

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

TEUCHOS_UNIT_TEST(Placement, MakesRunsOfTheLeastLargestLoad) {
  for (int seed = 1; seed <= 60; ++seed) {
    std::vector<long long> weights;
    for (int i = 0; i < 2 + seed % 9; ++i) weights.push_back((i * 7919 + seed * 104729) % (seed % 3 == 0 ? 7 : 1000));
    for (int ranks : {1, 2, 3, 4, 7}) {
      const std::vector<int> rankOf = placeInRuns(weights, ranks);
      const std::vector<long long> loads = loadsOf(weights, rankOf, ranks);
      TEST_ASSERT(std::is_sorted(rankOf.begin(), rankOf.end()));
      TEST_EQUALITY(*std::max_element(loads.begin(), loads.end()), leastLargest(weights, 0, ranks));
      // No rank is passed over; all have a unit if there are enough.
      for (std::size_t i = 1; i < rankOf.size(); ++i) TEST_COMPARE(rankOf[i], <=, rankOf[i - 1] + 1);
      TEST_EQUALITY(rankOf.front(), 0);
      TEST_EQUALITY(rankOf.back(), std::min(ranks, static_cast<int>(weights.size())) - 1);
    }
  }
  TEST_ASSERT(placeInRuns({}, 3).empty());
}

// Ten subdomains per rank or more are balanced within a tenth, those of equal cost within one.
TEUCHOS_UNIT_TEST(Placement, BalancesRunsOfManyUnits) {
  std::vector<long long> weights;
  for (int i = 0; i < 500; ++i) weights.push_back(500 + (i * 7919) % 997);
  for (int ranks : {2, 3, 8, 31, 50}) {
    const std::vector<long long> loads = loadsOf(weights, placeInRuns(weights, ranks), ranks);
    double total = 0.0;
    for (const long long weight : weights) total += static_cast<double>(weight);
    TEST_COMPARE(static_cast<double>(*std::max_element(loads.begin(), loads.end())), <, 1.1 * total / ranks);
    const std::vector<long long> equal(500, 3);
    for (const long long load : loadsOf(equal, placeInRuns(equal, ranks), ranks)) {
      TEST_COMPARE(load, >=, 3 * (500 / ranks));
      TEST_COMPARE(load, <=, 3 * (500 / ranks + 1));
    }
  }
}
