#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>
#include <suture/base/Errors.hpp>
#include <suture/partition/cut/Apportion.hpp>

using suture::apportion;
using Seats = std::vector<int>;

TEUCHOS_UNIT_TEST(Apportion, GivesTheLargestRemaindersTheRest) {
  // Exact shares 5.3, 2.9, 1.8.
  TEST_ASSERT(apportion({530, 290, 180}, 10) == (Seats{5, 3, 2}));
  // 3.34, 3.33, 3.33
  TEST_ASSERT(apportion({334, 333, 333}, 10) == (Seats{4, 3, 3}));
}

TEUCHOS_UNIT_TEST(Apportion, GivesEveryoneAtLeastOneAndNobodyMoreThanItsSize) {
  TEST_ASSERT(apportion({1000, 1, 1, 1}, 6) == (Seats{3, 1, 1, 1}));
  TEST_ASSERT(apportion({1000, 1, 1, 1}, 4) == (Seats{1, 1, 1, 1}));
  TEST_ASSERT(apportion({3, 2}, 5) == (Seats{3, 2}));
}

TEUCHOS_UNIT_TEST(Apportion, AlwaysGivesExactlyTheTotal) {
  const Seats sizes{7, 91, 13, 1, 44, 2};
  const int sum = std::accumulate(sizes.begin(), sizes.end(), 0);
  for (int total = 6; total <= sum; ++total) {
    const Seats seats = apportion(sizes, total);
    TEST_EQUALITY(std::accumulate(seats.begin(), seats.end(), 0), total);
    for (std::size_t i = 0; i < sizes.size(); ++i) TEST_ASSERT(seats[i] >= 1 && seats[i] <= sizes[i]);
  }
}

TEUCHOS_UNIT_TEST(Apportion, RefusesImpossibleNumbers) {
  TEST_THROW(apportion({2, 2}, 1), suture::InternalError);
  TEST_THROW(apportion({2, 2}, 5), suture::InternalError);
}
