#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include <suture/solver/MemoryEstimate.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(MemoryEstimate, IsRefusedOnAllRanksWithTheFigures) {
  const double mine = 1000.0 * (world()->getRank() + 1);
  const int ranks = world()->getSize();
  const double sum = 1000.0 * ranks * (ranks + 1) / 2;
  checkMemory(*world(), mine, sum + 1);
  try {
    checkMemory(*world(), mine, sum - 1);
    TEST_ASSERT(false);
  } catch (const EnvironmentError& error) {
    const std::string text = error.what();
    TEST_INEQUALITY(text.find("Memory Limit"), std::string::npos);
    TEST_INEQUALITY(text.find("Subdomains"), std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(MemoryEstimate, KnowsTheMachine) {
  TEST_COMPARE(availableMegabytes(), >, 10.0);
  TEST_COMPARE(availableMegabytes(), <, 1e8);
  checkMemory(*world(), 1.0, 0.0);
  TEST_THROW(checkMemory(*world(), 1e12, 0.0), EnvironmentError);
}

TEUCHOS_UNIT_TEST(MemoryEstimate, GrowsWithTheMesh) {
  double last = 0.0;
  for (const int n : {8, 16, 32}) {
    const Blocks all(blocks::square(2, n, 1.0), alone());
    const double estimate = estimatedMegabytes(all.meshes);
    TEST_COMPARE(estimate, >, last);
    last = estimate;
  }
  TEST_COMPARE(estimatedMegabytes({}), <, 100.0);
  TEST_FLOATING_EQUALITY(estimatedMonolithicMegabytes(937439), 1646.0, 0.02);  // measured; the formula was fitted to it
}

}  // namespace
}  // namespace suture
