#include "RemainingTime.hpp"

#include <algorithm>
#include <cmath>
#include <suture/report/Format.hpp>

namespace suture {

namespace {

constexpr double kLeastPart = 0.1;  // part of the work before an estimate makes sense
constexpr double kSteady = 3.0;     // largest ratio between the speed of the last half of the time and the mean speed
constexpr std::size_t kSteps = 3;   // load steps or objects before an estimate makes sense
constexpr std::size_t kIterations = 6;
constexpr double kQuickest = 1.0;  // seconds, and part of the time so far, in which the estimate follows a change of the speed
constexpr double kFollow = 0.1;
// A step that takes longer than this many times the longest one so far, and than this part of the time so far, is stuck: nothing is known.
constexpr double kStuck = 3.0, kStuckPart = 0.25;
constexpr double kOverdue = 0.9;  // part of a step that counts as done while the step takes longer than expected

}  // namespace

std::optional<RemainingTime::Work> RemainingTime::workOf(const Progress::State& state) {
  if (state.path >= 0.0) return Work{"path", state.path, 1.0, kSteps};
  const std::string name = format("%s %.6f %s ", state.phase.c_str(), state.since, state.step.c_str());
  // A residual of zero or below its tolerance: the iteration is about to end.
  if (state.residual > state.tolerance && state.tolerance > 0.0)
    return Work{name + format("%.17g", state.tolerance), -std::log(state.residual), -std::log(state.tolerance), kIterations};
  if (state.residual < 0.0 && state.done < state.total)
    return Work{name + state.unit, static_cast<double>(state.done), static_cast<double>(state.total), kSteps};
  return std::nullopt;
}

void RemainingTime::take(const Work& work, double now) {
  if (work.name != name_) {
    samples_.clear();
    shown_.reset();
    name_ = work.name;
  }
  least_ = work.least;
  whole_ = work.whole;
  // Residuals of conjugate gradients oscillate: only the smallest one so far counts.
  if (samples_.empty() || work.done > samples_.back().work) samples_.push_back({now, work.done});
}

/// From the speed over the last half of the time. Between two steps the work goes on at this speed, but does not complete one more step.
std::optional<double> RemainingTime::estimate(double now) const {
  if (samples_.size() <= least_) return std::nullopt;
  const Sample &first = samples_.front(), &last = samples_.back();
  if (last.time <= first.time) return std::nullopt;
  if (last.work - first.work < kLeastPart * (whole_ - first.work)) return std::nullopt;
  double longest = 0.0;
  for (std::size_t i = 1; i < samples_.size(); ++i) longest = std::max(longest, samples_[i].time - samples_[i - 1].time);
  if (now - last.time > std::max(kStuck * longest, kStuckPart * (last.time - first.time))) return std::nullopt;
  const double middle = 0.5 * (first.time + last.time);
  // At least one step lies behind the middle.
  const auto behind = std::find_if(samples_.begin(), samples_.end(), [&](const Sample& sample) { return sample.time > middle; });
  const Sample& from = *(behind - 1);
  const double speed = (last.work - from.work) / (last.time - from.time);
  const double step = last.work - samples_[samples_.size() - 2].work;
  const double reached = last.work + std::min(speed * (now - last.time), kOverdue * step);
  const double mean = (reached - first.work) / (now - first.time), recent = (reached - from.work) / (now - from.time);
  if (recent > kSteady * mean || mean > kSteady * recent) return std::nullopt;
  return std::max(0.0, (whole_ - reached) / recent);
}

std::optional<double> RemainingTime::after(const Progress::State& state, double now) {
  const std::optional<Work> work = workOf(state);
  if (!work) {
    shown_.reset();
    return shown_;
  }
  take(*work, now);
  const std::optional<double> found = estimate(now);
  if (!found || !shown_) {
    shown_ = found;
  } else {
    const double passed = now - shownAt_, expected = std::max(0.0, *shown_ - passed);
    const double quickness = std::max(kQuickest, kFollow * (now - samples_.front().time));
    shown_ = expected + (1.0 - std::exp(-passed / quickness)) * (*found - expected);
  }
  shownAt_ = now;
  return shown_;
}

std::string RemainingTime::words(double seconds) {
  if (seconds < 5.0) return "a few seconds";
  if (seconds < 57.5) return format("about %.0f s", 5.0 * std::round(seconds / 5.0));
  if (seconds < 3570.0) return format("about %.0f min", std::max(1.0, std::round(seconds / 60.0)));
  return format("about %.1f h", seconds / 3600.0);
}

}  // namespace suture
