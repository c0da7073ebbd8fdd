#pragma once
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <suture/base/Progress.hpp>
#include <thread>

namespace suture {

/// Prints the progress of a phase, or of all load steps together, that takes longer than two seconds: work done, and the time left if it
/// can be estimated (RemainingTime). On a terminal it updates one line every second until the next text; otherwise it prints lines to
/// standard error at increasing intervals. Runs in its own thread during its lifetime.
class Heartbeat {
 public:
  /// \param speaks  false: silent (--quiet; ranks without a console)
  explicit Heartbeat(bool speaks);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// "factor: 4 s, factoring the subdomains, 120 of 512 subdomains, about 15 s left"
  /// \param left  seconds left, if known
  static std::string line(const Progress::State& state, double now, std::optional<double> left = std::nullopt);

 private:
  void beat();

  Progress progress_;
  Progress::Watch watch_{progress_};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace suture
