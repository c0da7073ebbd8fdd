// Against labels that are overwritten at every join.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <random>
#include <suture/algebra/DisjointSets.hpp>
#include <vector>

using namespace suture;

TEUCHOS_UNIT_TEST(DisjointSets, AreKnownByTheirLowestMembers) {
  const int count = 60;
  DisjointSets sets(count);
  std::vector<int> label(count);
  for (int i = 0; i < count; ++i) label[i] = i;
  std::mt19937 next(2);
  for (int step = 0; step < 80; ++step) {
    const int i = static_cast<int>(next() % count), j = static_cast<int>(next() % count);
    const int low = std::min(label[i], label[j]), high = std::max(label[i], label[j]);
    for (int& own : label)
      if (own == high) own = low;
    const int joined = sets.join(i, j);  // the macro evaluates its arguments twice
    TEST_EQUALITY(joined, low);
    for (int k = 0; k < count; ++k) TEST_EQUALITY(sets.lowest(k), label[k]);
  }
}
