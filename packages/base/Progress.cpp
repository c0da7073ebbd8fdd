#include <suture/base/Progress.hpp>
#include <suture/base/Timers.hpp>

namespace suture {

namespace {
thread_local Progress* watched = nullptr;
}

Progress::State Progress::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_;
}

template <typename Change>
void Progress::change(const Change& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  change(state_);
}

Progress::Watch::Watch(Progress& progress) : before_(watched) { watched = &progress; }
Progress::Watch::~Watch() { watched = before_; }

void Progress::phase(const std::string& name) {
  if (!watched) return;
  watched->change([&](State& state) {
    State next;
    next.phase = name;
    next.since = Timers::now();
    next.path = state.path;
    next.pathSince = state.pathSince;
    state = next;
  });
}

Progress::Path::Path() {
  if (!watched) return;
  watched->change([](State& state) {
    state.path = 0.0;
    state.pathSince = Timers::now();
  });
}

Progress::Path::~Path() {
  if (watched) watched->change([](State& state) { state.path = -1.0; });
}

void Progress::Path::reach(double part) const {
  if (watched) watched->change([part](State& state) { state.path = part; });
}

Progress::Step::Step(const std::string& name) {
  if (!watched) return;
  watched->change([&](State& state) {
    state.step = name;
    if (state.residual < 0.0) state.done = state.total = 0;  // within an iteration, the counts are those of the iteration
  });
}

Progress::Step::~Step() {
  if (watched) watched->change([](State& state) { state.step.clear(); });
}

void Progress::count(const char* unit, long total) {
  if (!watched) return;
  watched->change([&](State& state) {
    state.unit = unit;
    state.total = total;
    ++state.done;
  });
}

void Progress::iteration(long number, double residual, double tolerance) {
  if (!watched) return;
  watched->change([&](State& state) {
    state.done = number;
    state.total = 0;
    state.residual = residual;
    state.tolerance = tolerance;
  });
}

}  // namespace suture
