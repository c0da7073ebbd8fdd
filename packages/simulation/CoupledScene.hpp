#pragma once
#include <suture/simulation/CouplingSurface.hpp>
#include <suture/simulation/RepeatedSolver.hpp>
#include <suture/simulation/Stages.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// A scene coupled to another program that loads or moves side groups and changes these values from solve to solve:
///
///     CoupledScene coupled(comm, scene);
///     const CouplingSurface surface = coupled.surface("block_top");
///     for (...) {
///       coupled.setForces(surface, forces);
///       coupled.solve();
///       displacements = coupled.displacements(surface);
///     }
///
/// Prescribed rigid motions are not removed from a coupled scene. All functions are collective, except the const accessors.
class CoupledScene {
 public:
  /// Reads and cuts the scene. \throws InputError  a scene with load steps or controlled loads
  CoupledScene(RunContext run, Scene scene);
  /// The same without output to the console.
  CoupledScene(const CommPtr& comm, Scene scene) : CoupledScene(RunContext(comm), std::move(scene)) {}

  /// Nodes of a side group. Before the first solve(), once per group. \throws InputError  an unknown group (suggests the nearest name)
  CouplingSurface surface(const std::string& group);
  /// Sets the forces on the surface's nodes, in addition to the loads of the scene: nodes x dimension, node-major, Cartesian [force];
  /// initially zero. \throws InputError  a wrong number of values, or a value that is not finite
  void setForces(const CouplingSurface& surface, const std::vector<double>& forces);
  /// Sets the forces from tractions at the nodes, interpolated by the shape functions [stress].
  void setTractions(const CouplingSurface& surface, const std::vector<double>& tractions);
  /// Sets the displacements of the surface's nodes in the components that a condition of the scene prescribes there; the other components
  /// stay free [length]. \throws InputError  as for forces; nodes in a contact
  void setDisplacements(const CouplingSurface& surface, const std::vector<double>& displacements);
  /// Solves with the present loads; the first call checks and prepares the scene. Factors are kept, except by methods that cannot reload
  /// (Condensed Groups, Monolithic), and the last solution is the initial guess.
  /// \param verified  calls verify(), which takes about a third of the time of a solve
  const Solution& solve(bool verified = true);
  /// Verifies the last solution: undetermined motions, errors, verdict, extremes. After solve().
  const Solution& verify();
  /// Accepts the last solution as the end of a step: with friction, slip continues from there. No effect without friction. After solve().
  void advance();
  /// Displacements of the surface's nodes in the last solution, ordered as the forces; zero before the first solution [length]. Local.
  std::vector<double> displacements(const CouplingSurface& surface) const;

  const Scene& scene() const { return parts_->scene; }
  const std::vector<SubdomainMesh>& meshes() const { return parts_->cut.meshes; }  ///< subdomains of this rank
  const ProblemSize& size() const { return parts_->size; }
  const Solution& solution() const {  ///< after solve()
    mustBeSolved("solution");
    return solution_;
  }
  ExitCode ending() const { return endingOf(solution_); }  ///< Done only after verify()
  /// Text of summary.json of the last solution, after verify(): on rank 0, empty on other ranks.
  std::string summary(const Invocation& invocation = {}) const;

 private:
  Load& loadOf(const CouplingSurface& surface, const std::string& function);
  void prepareScene();
  void mustBeSolved(const std::string& function) const;

  std::optional<PartitionedScene> partitioned_;  // until the first solve
  std::unique_ptr<SceneParts> owned_;            // afterwards
  SceneParts* parts_;
  std::optional<RepeatedSolver> solver_;
  Solution solution_;
  bool isSolved_ = false, isJudged_ = false;
};

}  // namespace suture
