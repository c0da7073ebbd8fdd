#pragma once
#include <suture/simulation/CoupledScene.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Together.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// A run of a scene, with its solution: all stages once, or coupled to the script.
class PythonRun {
 public:
  /// Collective. \param text  of the scene, XML;  \param name  for messages;  \param folder  base of relative file names
  /// \param shows  prints the table of the run  \param mesh  suture.Mesh of a scene whose mesh is given, or None; rank 0 uses it
  PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
            const std::vector<std::string>& overrides, bool shows, const py::object& mesh);
  /// Does not free its vectors after the interpreter has ended: an object in a global variable outlives the libraries that free them.
  ~PythonRun();
  PythonRun(const PythonRun&) = delete;
  PythonRun& operator=(const PythonRun&) = delete;

  /// Runs all stages. Collective. \param output  folder of the files, if any  \param restart  initial checkpoint, or ""
  void solve(const std::optional<std::string>& output, const std::string& restart);

  /// Calls a collective function of the coupled scene, which is made at the first call; an exception on one rank is raised on all
  /// (together()). Collective.
  void doCoupled(const std::function<void(CoupledScene&)>& way);
  /// Calls a function on all ranks; an exception on one rank is raised on all. Collective.
  void doTogether(const std::function<void()>& way);

  /// Writes the results into a folder. Collective.
  void writeTo(const std::string& folder);
  /// Recovered stresses of each subdomain of this rank, computed at the first call. Collective.
  const std::vector<Matrix>& nodalStresses();
  /// The probes of the scene, and on rank 0 their values. Collective.
  std::vector<std::pair<Probe, std::vector<ProbeValue>>> probes();
  /// Values at points, on rank 0. \param points  points x dimension, the same on all ranks  \param body  name, or "": any body. Collective.
  std::vector<ProbeValue> valuesAt(const Matrix& points, const std::string& body);

  const CoupledScene& coupled() const;
  const Scene& scene() const;
  const std::vector<SubdomainMesh>& meshes() const;
  const Solution& solution() const;
  ExitCode ending() const;
  bool isDone() const { return ending() == ExitCode::Done; }
  int exitCode() const { return static_cast<int>(ending()); }
  /// Reason if it is not done.
  std::string failure() const;
  const std::string& summary() const { return summary_; }  ///< text of summary.json, on rank 0
  const std::vector<std::string>& notes() const { return parts_->monitor.notes(); }
  std::vector<OuterRow> history() const { return parts_->monitor.rows(); }

 private:
  /// Members that depend on MPI and Kokkos.
  struct Parts {
    CommPtr comm;
    MeetingPoint meeting;
    Timers timers;
    RunMonitor monitor;
    Scene scene;
    std::optional<JudgedScene> judged;
    std::optional<CoupledScene> coupled;
    std::optional<std::vector<Matrix>> nodal;

    Parts(const CommPtr& ranks, bool shows);
  };

  const JudgedScene& judged() const;

  py::object held_;  // the mpi4py communicator
  std::unique_ptr<Parts> parts_;
  std::string summary_;
};

}  // namespace python
}  // namespace suture
