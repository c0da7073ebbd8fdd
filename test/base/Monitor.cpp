#include <suture/base/Monitor.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <vector>

namespace {

using namespace suture;

class Recorder : public Monitor {
 public:
  void outer(const OuterRow& row) override { iterations.push_back(row.iteration); }
  std::vector<int> iterations;
};

/// A solver's view of its observer.
void iterate(Monitor& monitor) {
  monitor.note("starts");
  monitor.auxiliary(AuxiliaryRow());
  for (int k = 1; k <= 3; ++k) {
    OuterRow row;
    row.iteration = k;
    monitor.outer(row);
    if (monitor.wantsInner()) monitor.inner(k, 0.1);
  }
}

TEUCHOS_UNIT_TEST(Monitor, ListenerReceivesOverriddenEventsThroughTheBase) {
  Recorder recorder;
  iterate(recorder);
  TEST_ASSERT((recorder.iterations == std::vector<int>{1, 2, 3}));
}

TEUCHOS_UNIT_TEST(Monitor, WantsNoInnerIterationsByDefault) {
  Monitor silent;
  TEST_NOTHROW(iterate(silent));
  TEST_ASSERT(!silent.wantsInner());
}

}  // namespace
