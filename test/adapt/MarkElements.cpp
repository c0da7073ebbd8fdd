#include <suture/adapt/MarkElements.hpp>
#include <suture/base/Errors.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <algorithm>
#include <numeric>
#include <random>

using namespace suture;

TEUCHOS_UNIT_TEST(MarkElements, FindsTheSmallestOfAllSubsets) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> squares(10);
    for (double& square : squares) square = std::pow(std::uniform_real_distribution<double>()(random), 4);
    const double theta = 0.05 + 0.9 * std::uniform_real_distribution<double>()(random);
    const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
    int least = 10;
    for (int set = 0; set < 1 << 10; ++set) {
      double part = 0;
      int count = 0;
      for (int e = 0; e < 10; ++e)
        if (set >> e & 1) part += squares[e], ++count;
      if (part >= theta * sum) least = std::min(least, count);
    }
    const std::vector<char> marked = markElements(squares, theta);
    double part = 0;
    for (int e = 0; e < 10; ++e) part += marked[e] ? squares[e] : 0;
    TEST_COMPARE(part, >=, theta * sum * (1 - 1e-14));
    TEST_EQUALITY(std::count(marked.begin(), marked.end(), 1), least);
  }
}

TEUCHOS_UNIT_TEST(MarkElements, TreatsEqualErrorsAlike) {
  std::vector<double> squares{4, 1, 1 + 1e-9, 1 - 1e-9, 1e-3};  // the fraction needs one of the three
  const std::vector<char> expected{1, 1, 1, 1, 0};
  TEST_ASSERT(markElements(squares, 0.6) == expected);
  std::swap(squares[1], squares[3]);
  TEST_ASSERT(markElements(squares, 0.6) == expected);
}

TEUCHOS_UNIT_TEST(MarkElements, MarksNothingWithoutErrorAndEverythingWithAllOfIt) {
  TEST_ASSERT(markElements({0, 0, 0}, 0.6) == std::vector<char>({0, 0, 0}));
  TEST_ASSERT(markElements({}, 0.6).empty());
  TEST_ASSERT(markElements({3, 0, 1e-9, 2}, 1.0) == std::vector<char>({1, 0, 1, 1}));
}

TEUCHOS_UNIT_TEST(MarkElements, RefusesWhatIsNoError) {
  TEST_THROW(markElements({1, -1}, 0.6), InternalError);
  TEST_THROW(markElements({1, std::numeric_limits<double>::quiet_NaN()}, 0.6), InternalError);
  TEST_THROW(markElements({1, 2}, 0), InternalError);
  TEST_THROW(markElements({1, 2}, 1.5), InternalError);
}
