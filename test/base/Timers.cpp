#include <suture/base/Timers.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <chrono>
#include <thread>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Timers, ScopesOfOnePhaseAddUp) {
  Timers timers;
  for (int i = 0; i < 2; ++i) {
    const Timers::Scope scope(timers, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  TEST_COMPARE(timers.seconds("sleep"), >=, 0.04);
  TEST_COMPARE(timers.seconds("sleep"), <=, timers.total());
  TEST_EQUALITY(timers.seconds("never"), 0.0);
}

TEUCHOS_UNIT_TEST(Timers, StatisticsAreOverAllRanksInTheOrderOfTheFirstBegin) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  const int ranks = comm->getSize(), rank = comm->getRank();
  Timers timers;
  timers.add("solve", 1.0 + rank);
  timers.add("assemble", 2.0);
  if (rank == ranks - 1) timers.add("write", 3.0);  // the others never enter it

  const auto all = timers.statistics(*comm);
  TEST_EQUALITY(all.size(), 3u);
  TEST_EQUALITY(all[0].phase, "solve");
  TEST_EQUALITY(all[0].min, 1.0);
  TEST_EQUALITY(all[0].max, 1.0 * ranks);
  TEST_FLOATING_EQUALITY(all[0].avg, 0.5 * (1.0 + ranks), 1e-15);
  TEST_EQUALITY(all[1].phase, "assemble");
  TEST_EQUALITY(all[1].avg, 2.0);
  TEST_EQUALITY(all[2].phase, "write");
  TEST_EQUALITY(all[2].min, ranks == 1 ? 3.0 : 0.0);
  TEST_FLOATING_EQUALITY(all[2].avg, 3.0 / ranks, 1e-15);
}

TEUCHOS_UNIT_TEST(Timers, PeakMemoryGrowsWithTouchedPages) {
  const double before = peakMemoryMb();
  std::vector<double> block(64 * 1024 * 1024 / sizeof(double), 1.0);
  TEST_COMPARE(peakMemoryMb(), >=, before + 32.0 * block[block.size() / 2]);
  TEST_COMPARE(before, >, 1.0);
}

TEUCHOS_UNIT_TEST(Timers, PeakMemoryFallsWhenItIsReset) {
  {
    std::vector<double> block(96 * 1024 * 1024 / sizeof(double), 1.0);
    TEST_COMPARE(peakMemoryMb(), >, 96.0 * block[block.size() / 2]);
  }
  const double before = peakMemoryMb();
  if (!resetPeakMemory()) return;  // a container may forbid it
  TEST_COMPARE(peakMemoryMb(), <, before - 64.0);
}

}  // namespace
