#pragma once
#include <optional>
#include <string>
#include <suture/base/Progress.hpp>
#include <vector>

namespace suture {

/// Estimates the time that the work reported by a Progress will still take: of the load path, if there is one; otherwise of the iteration
/// that is in progress (from the rate at which its residual falls), or of the objects that are counted.
///
/// There is no estimate before a tenth of the work is done in several steps, nor while a step is stuck, nor while the speed of the last
/// half of the time differs much from the mean speed: then nothing is known about the rest. The estimate is smoothed: it counts down, and
/// follows the speed gradually.
class RemainingTime {
 public:
  /// Takes a state. Call it in the order of time, about once a second or more often.
  /// \param now  by the same clock as State::since [s]  \return the seconds left; nothing: unknown
  std::optional<double> after(const Progress::State& state, double now);

  /// "a few seconds", "about 40 s", "about 12 min", "about 3.5 h"
  static std::string words(double seconds);

 private:
  /// Work done at a time, in a unit in which it grows at a steady rate: part of the path, logarithm of the residual, objects.
  struct Sample {
    double time, work;
  };
  struct Work {
    std::string name;          ///< differs between two different works
    double done = 0.0, whole;  ///< in the same unit
    std::size_t least;         ///< steps before an estimate makes sense
  };
  static std::optional<Work> workOf(const Progress::State& state);
  void take(const Work& work, double now);
  std::optional<double> estimate(double now) const;

  std::string name_;
  std::vector<Sample> samples_;  // at the start, and after each step
  std::size_t least_ = 0;
  double whole_ = 0.0;
  std::optional<double> shown_;
  double shownAt_ = 0.0;
};

}  // namespace suture
