#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <suture/base/Progress.hpp>
#include <thread>

namespace suture {

/// Tells on the console where the run is while a phase takes longer than two seconds: what is done, what is left. On a terminal a line that
/// goes with the next text, once a second; elsewhere a line on standard error, at longer and longer intervals. A thread of its own while it
/// lives.
class Heartbeat {
 public:
  /// \param speaks  false: silent (--quiet; ranks without a console)
  explicit Heartbeat(bool speaks);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// "factor: 4 s, factoring the subdomains, 120 of 512 subdomains"
  static std::string line(const Progress::State& state, double now);

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
