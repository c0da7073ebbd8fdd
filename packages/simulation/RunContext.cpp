#include <suture/simulation/RunContext.hpp>

namespace suture {

RunContext::RunContext(const CommPtr& comm)
    : comm_(comm), monitor_(std::make_shared<RunMonitor>(nullptr, false)), timers_(std::make_shared<Timers>()) {}

RunContext::RunContext(const CommPtr& comm, RunMonitor& monitor, Timers& timers)
    : comm_(comm), monitor_(&monitor, [](RunMonitor*) {}), timers_(&timers, [](Timers*) {}) {}

void RunContext::writeInto(const std::string& folder) {
  folder_ = folder;
  output_ = std::make_shared<const RunFolder>(*comm_, folder);
  if (!output_->liveHistory().empty()) monitor_->recordIn(output_->liveHistory());
}

}  // namespace suture
