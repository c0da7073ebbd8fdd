#pragma once
#include <suture/simulation/Simulation.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Together.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// A scene on its way to the answer, and the answer.
class PythonRun {
 public:
  /// Collective. \param text  of the scene, XML;  \param name  of it, in messages;  \param folder  that its relative names start from
  /// \param shows  prints the table of the run
  PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
            const std::vector<std::string>& overrides, bool shows);
  /// Leaves its vectors where they are once the interpreter has ended: an object in a global variable dies after all that could free them.
  ~PythonRun();
  PythonRun(const PythonRun&) = delete;
  PythonRun& operator=(const PythonRun&) = delete;

  /// The whole way. Collective. \param output  folder of the files; none without one  \param restart  a checkpoint to begin with, or ""
  void solve(const std::optional<std::string>& output, const std::string& restart);

  /// Solves with loads as they are now (Simulation::coupling). Collective. \param verified  judges the answer
  void solveAgain(bool verified);

  /// Something that all ranks do with the simulation: an exception of one is one of all (together()). Collective.
  void doTogether(const std::function<void(Simulation&)>& way);

  const Simulation& simulation() const { return *parts_->simulation; }
  bool isDone() const { return simulation().ending() == ExitCode::Done; }
  int exitCode() const { return static_cast<int>(simulation().ending()); }
  /// Why it is not done.
  std::string failure() const;
  const std::string& summary() const { return summary_; }  ///< text of summary.json, on rank 0
  const std::vector<std::string>& notes() const { return parts_->monitor.notes(); }
  std::vector<OuterRow> history() const { return parts_->monitor.rows(); }

 private:
  /// What knows MPI and Kokkos.
  struct Parts {
    CommPtr comm;
    MeetingPoint meeting;
    Timers timers;
    RunMonitor monitor;
    std::unique_ptr<Simulation> simulation;

    Parts(const CommPtr& ranks, bool shows);
  };

  py::object held_;  // mpi4py's communicator
  std::unique_ptr<Parts> parts_;
  std::string summary_;
};

}  // namespace python
}  // namespace suture
