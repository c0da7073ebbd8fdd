#pragma once
#include <suture/report/RunMonitor.hpp>

#include <functional>

namespace suture {

/// SIGUSR1, SIGTERM and SIGINT end the run after the current outer iteration, with a checkpoint and exit code 75. For SIGTERM and SIGINT,
/// if no iteration ends within four seconds (reading the mesh, factoring, a long iteration), the process ends with 75 and without a new
/// checkpoint; a second signal ends it at once.
void listenForStop(RunMonitor& monitor);

/// For a host program (Python) with its own signal handlers: during its lifetime, listenForStop() installs no handlers but queries the
/// host.
class StopsByHost {
 public:
  explicit StopsByHost(std::function<bool()> isAsked);
  ~StopsByHost();
  StopsByHost(const StopsByHost&) = delete;
  StopsByHost& operator=(const StopsByHost&) = delete;
};

/// True if a stop signal was received, on this rank.
bool stopWasAsked();

/// Call when the iterations have ended: verification and output may then take any time. Local.
void stopIsHeard();

/// True if a write to the file descriptor would return at once, with success or failure, instead of blocking for a reader. Waits for this
/// condition until a signal arrives or the time is over.
/// Safe in signal handlers.
bool takesText(int file, int milliseconds);

}  // namespace suture
