#pragma once
#include <suture/base/Timers.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/RunMonitor.hpp>

#include <memory>
#include <string>

namespace suture {

/// Ranks, output and clocks of a run, which all its stages use. Copies share everything.
class RunContext {
 public:
  /// Without output to the console.
  explicit RunContext(const CommPtr& comm);
  /// \param monitor, timers  must outlive all copies
  RunContext(const CommPtr& comm, RunMonitor& monitor, Timers& timers);

  /// Creates and locks the output folder. The files of a run are written there, and checkpoints during the solution if the settings request
  /// them. Collective. \throws EnvironmentError
  void writeInto(const std::string& folder);

  const Comm& comm() const { return *comm_; }
  const CommPtr& commPtr() const { return comm_; }
  RunMonitor& monitor() const { return *monitor_; }
  Timers& timers() const { return *timers_; }
  /// True if files are written.
  bool writes() const { return output_ != nullptr; }
  const std::string& folder() const { return folder_; }

 private:
  CommPtr comm_;
  std::shared_ptr<RunMonitor> monitor_;
  std::shared_ptr<Timers> timers_;
  std::string folder_;
  std::shared_ptr<const RunFolder> output_;
};

}  // namespace suture
