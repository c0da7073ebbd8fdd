#pragma once
#include <suture/simulation/Simulation.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Bindings.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// A scene on its way to the answer, and the answer.
class PythonRun {
 public:
  /// Collective. \param text  of the scene, XML;  \param name  of it, in messages;  \param folder  that its relative names start from
  /// \param shows  prints the table of the run
  PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
            const std::vector<std::string>& overrides, bool shows);

  /// The whole way. Collective. \param output  folder of the files; none without one  \param restart  a checkpoint to begin with, or ""
  void solve(const std::optional<std::string>& output, const std::string& restart);

  /// Solves with loads as they are now (Simulation::coupling). Collective. \param verified  judges the answer
  void solveAgain(bool verified);

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  int rank() const;
  bool isDone() const { return simulation_.ending() == ExitCode::Done; }
  int exitCode() const { return static_cast<int>(simulation_.ending()); }
  /// Why it is not done.
  std::string failure() const;
  const std::string& summary() const { return summary_; }  ///< text of summary.json, on rank 0
  const std::vector<std::string>& notes() const { return monitor_.notes(); }
  std::vector<OuterRow> history() const { return monitor_.rows(); }

 private:
  /// Goes a way that Ctrl-C ends after the iteration in hand.
  template <typename Way>
  void go(const Way& way);

  py::object held_;  // mpi4py's communicator
  CommPtr comm_;
  Timers timers_;
  RunMonitor monitor_;
  Simulation simulation_;
  std::string summary_;
};

}  // namespace python
}  // namespace suture
