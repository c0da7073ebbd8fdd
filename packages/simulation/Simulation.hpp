#pragma once
#include <suture/simulation/Stages.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// All stages of a scene in one call:
///
///     Simulation simulation(comm, scene);
///     const Solution& solution = simulation.solve();
///
/// Programs that act between the stages call the functions of Stages.hpp. All functions are collective, except the const accessors.
class Simulation {
 public:
  /// Without output to the console.
  Simulation(const CommPtr& comm, Scene scene) : Simulation(RunContext(comm), std::move(scene)) {}
  Simulation(RunContext run, Scene scene) : run_(std::move(run)), scene_(std::move(scene)) {}

  /// Writes the files of report() into a folder (RunContext::writeInto()). Before solve().
  void writeInto(const std::string& folder) { run_.writeInto(folder); }
  /// Runs all stages. A second call returns the same solution.
  /// \param restart  checkpoint of an earlier run on this mesh, from which to start
  /// \throws Error  of any kind, the same on all ranks, again in each call
  const Solution& solve(const std::string& restart = "");
  /// Writes the results. \throws InternalError  before solve(); without an output folder
  RunResult report(const Invocation& invocation = {}) const { return judged("report").report(invocation); }

  // After solve(); before, an InternalError.
  const JudgedScene& judged() const { return judged("judged"); }
  const Solution& solution() const { return judged("solution").solution(); }
  const Scene& scene() const { return judged("scene").scene(); }
  const std::vector<SubdomainMesh>& meshes() const { return judged("meshes").meshes(); }  ///< subdomains of this rank
  const ProblemSize& size() const { return judged("size").size(); }
  ExitCode ending() const { return judged("ending").ending(); }

 private:
  const JudgedScene& judged(const std::string& function) const;

  RunContext run_;
  Scene scene_;
  std::optional<JudgedScene> judged_;
};

}  // namespace suture
