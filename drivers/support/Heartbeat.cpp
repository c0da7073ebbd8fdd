#include "Heartbeat.hpp"

#include <chrono>
#include <iostream>
#include <suture/base/Timers.hpp>
#include <suture/report/Format.hpp>

#include "RemainingTime.hpp"
#include "StoppableOutput.hpp"

namespace suture {

namespace {
constexpr double patience = 2.0;  // seconds of a phase without output
constexpr double longer = 1.6;    // in files, ratio between the times of successive lines in a phase
constexpr std::chrono::milliseconds glance(100);
}  // namespace

Heartbeat::Heartbeat(bool speaks) {
  if (speaks) thread_ = std::thread([this] { beat(); });
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::string Heartbeat::line(const Progress::State& state, double now, std::optional<double> left) {
  const bool isPath = state.path >= 0.0;
  const std::string ofRest = left ? RemainingTime::words(*left) : "";
  std::string text = "   ... ";
  if (isPath) {
    text += format("load steps: %.0f s, %.0f %% done", now - state.pathSince, 100.0 * state.path);
    if (left) text += ", " + ofRest + " left";
    text += "; ";
  }
  text += format("%s: %.0f s", state.phase.c_str(), now - state.since);
  if (!state.step.empty()) text += ", " + state.step;
  if (state.residual >= 0.0)
    text += format(", iteration %ld, residual %.1e of %.1e", state.done, state.residual, state.tolerance) +
            (left && !isPath ? " in " + ofRest : "");
  else if (state.total > 0)
    text += format(", %ld of %ld %s", state.done, state.total, state.unit.c_str()) + (left && !isPath ? ", " + ofRest + " left" : "");
  return text;
}

void Heartbeat::beat() {
  auto* output = dynamic_cast<StoppableOutput*>(std::cout.rdbuf());
  RemainingTime remaining;
  double phase = 0.0, next = 0.0;
  if (!output) return;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, glance, [this] { return ends_; })) {
    const Progress::State state = progress_.state();
    const double now = Timers::now();
    const std::optional<double> left = remaining.after(state, now);
    if (state.phase.empty()) continue;
    if (const double since = state.path >= 0.0 ? state.pathSince : state.since; since != phase) {
      phase = since;
      next = phase + patience;
    }
    if (now < next) continue;
    output->between(line(state, now, left));
    next = output->isTerminal() ? now + 1.0 : phase + longer * (now - phase);
  }
}

}  // namespace suture
