#pragma once
#include <suture/report/RunMonitor.hpp>

#include <functional>

namespace suture {

/// SIGUSR1, SIGTERM and SIGINT end the run after the outer iteration in hand, with a checkpoint and exit code 75. SIGTERM and SIGINT are
/// in a hurry: where no iteration has ended four seconds later (the mesh is read, matrices are factored, a long iteration), the process
/// ends with 75 and without a new checkpoint; a second one ends it at once.
void listenForStop(RunMonitor& monitor);

/// A host program (Python) has handlers of signals of its own: while this lives, listenForStop() leaves them alone and asks the host.
class StopsByHost {
 public:
  explicit StopsByHost(std::function<bool()> isAsked);
  ~StopsByHost();
  StopsByHost(const StopsByHost&) = delete;
  StopsByHost& operator=(const StopsByHost&) = delete;
};

/// True if such a signal came, on this rank.
bool stopWasAsked();

/// The iterations have ended: the verdict and the files may take as long as they need. Local.
void stopIsHeard();

/// True if a write to the file descriptor returns at once, with success or failure, instead of waiting for a reader. Waits for that until a
/// signal comes or the time is over.
/// May be called by a handler of signals.
bool takesText(int file, int milliseconds);

}  // namespace suture
