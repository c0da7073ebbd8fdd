#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/base/Timers.hpp>

#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <thread>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Progress, ReportsPhaseStepAndCount) {
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  Progress progress;
  Timers timers;
  Progress::State inside;
  {
    const Progress::Watch watch(progress);
    const Timers::Scope scope(timers, "factor");
    collectively(*comm, "factoring the subdomains", [&] {
      for (int i = 0; i < 3; ++i) Progress::count("subdomains", 7);
      std::thread([&] { inside = progress.state(); }).join();
    });
    TEST_EQUALITY(progress.state().step, "");
    TEST_EQUALITY(progress.state().phase, "factor");
  }
  TEST_EQUALITY(inside.phase, "factor");
  TEST_EQUALITY(inside.step, "factoring the subdomains");
  TEST_EQUALITY(inside.unit, "subdomains");
  TEST_EQUALITY(inside.done, 3);
  TEST_EQUALITY(inside.total, 7);
  TEST_ASSERT(inside.since > 0.0 && inside.since <= Timers::now());
}

TEUCHOS_UNIT_TEST(Progress, ReportsIterations) {
  Progress progress;
  const Progress::Watch watch(progress);
  Progress::phase("solve");
  for (int k = 1; k <= 4; ++k) {
    const Progress::Step step("applying the operator");
    Progress::iteration(k, 1.0 / k, 1e-8);
  }
  const Progress::State state = progress.state();
  TEST_EQUALITY(state.done, 4);
  TEST_EQUALITY(state.residual, 0.25);
  TEST_EQUALITY(state.tolerance, 1e-8);
  Progress::phase("");
  TEST_EQUALITY(progress.state().phase, "");
}

TEUCHOS_UNIT_TEST(Progress, ComesFromTheWatchedThreadOnly) {
  Progress outer, inner;
  const Progress::Watch watch(outer);
  {
    const Progress::Watch another(inner);
    Progress::phase("read");
  }
  Progress::phase("partition");
  std::thread([] { Progress::phase("write"); }).join();
  TEST_EQUALITY(inner.state().phase, "read");
  TEST_EQUALITY(outer.state().phase, "partition");
}

}  // namespace
