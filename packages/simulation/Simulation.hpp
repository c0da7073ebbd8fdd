#pragma once
#include <suture/answer/Doubts.hpp>
#include <suture/answer/Overlaps.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/Run.hpp>
#include <suture/report/RunMonitor.hpp>
#include <suture/simulation/CouplingSurface.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/LoadPath.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/StageOrder.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// How a run ended.
struct RunResult {
  ExitCode code = ExitCode::Done;
  std::string failure = {};  ///< reason if the run did not converge
  std::string summary = {};  ///< text of summary.json, on rank 0; empty if nothing was written
};

/// All stages from a scene to its solution. solve() runs them in one call:
///
///     const Solution solution = Simulation(comm, scene).solve();
///
/// Programs that need to act between the stages call read(), cut(), check(), prepare(), iterate() and judge(), each once and in this order;
/// any other order is an InternalError. Only the monitor prints, and files are written only after writeInto(). All functions are
/// collective, except the const accessors.
/// \throws Error  of any kind, the same on all ranks
class Simulation {
 public:
  /// Without output to the console.
  Simulation(const CommPtr& comm, Scene scene);
  /// \param monitor, timers  must outlive it
  Simulation(const CommPtr& comm, Scene scene, RunMonitor& monitor, Timers& timers);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Creates and locks the output folder. The files of a run are written there, and checkpoints during the solution if the settings request
  /// them.
  /// \throws EnvironmentError
  void writeInto(const std::string& folder);

  /// Runs all stages except report(). A second call returns the same solution.
  const Solution& solve();

  /// Reads mesh and constraints, if a later stage needs the whole mesh.
  void read();
  /// Creates the subdomains on their ranks, with their loads.
  void cut();
  /// Refuses elements that lock, scenes without a solution, exact solutions without a value, probes outside the bodies, and runs that
  /// exceed the memory.
  void check();
  /// Finds the amounts of controlled loads, removes prescribed rigid motions from the scene, assembles and factors.
  void prepare();
  /// Adds notes on the partition and on the settings.
  void remark();
  /// Sets the initial guess: the checkpoint of an earlier run on this mesh, or, if `restart` is empty, a nested start from Scene::levels.
  void start(const std::string& restart = "");
  /// Sets another initial guess.
  void startFrom(Start start);
  /// Solves. With load steps, each step is verified, and its fields and a checkpoint are written.
  void iterate();
  /// Settles undetermined motions, computes errors and verifies the solution. Last computing stage: it frees all factors.
  void judge();
  /// Writes the results, and the last lines of the console.
  /// \param invocation  for the record
  RunResult report(const Invocation& invocation = {});
  /// Text of summary.json on rank 0, empty on other ranks; after judge(). Writes no file.
  std::string summary(const Invocation& invocation = {}) const;

  /// Couples the scene to another program that loads or moves a side group and changes these values from solve to solve:
  ///
  ///     const CouplingSurface surface = simulation.coupling("block_top");
  ///     for (...) {
  ///       simulation.setForces(surface, forces);
  ///       simulation.solveAgain();
  ///       displacements = simulation.displacements(surface);
  ///     }
  ///
  /// Reads and cuts the scene if that is not done yet. Call before prepare(), once per group. Prescribed rigid motions are not removed from
  /// a coupled scene, nor from a scene with load steps.
  /// \throws InputError  an unknown group (suggests the nearest name); a scene with load steps or controlled loads
  CouplingSurface coupling(const std::string& group);
  /// Sets the forces on the surface's nodes: nodes x dimension, node-major, Cartesian [force]; initially zero. They are added to the loads
  /// of the scene. \throws InputError  a wrong number of values, or a value that is not finite
  void setForces(const CouplingSurface& surface, const std::vector<double>& forces);
  /// Sets the forces from tractions at the nodes, interpolated by the shape functions [stress].
  void setTractions(const CouplingSurface& surface, const std::vector<double>& tractions);
  /// Sets the displacements of the surface's nodes in the components that a condition of the scene prescribes there; the other components
  /// stay free [length]. \throws InputError  as for forces; nodes in a contact
  void setDisplacements(const CouplingSurface& surface, const std::vector<double>& displacements);
  /// Solves with the present loads; the first call runs all earlier stages. Factors are kept, except by methods that cannot reload
  /// (Condensed Groups, Monolithic), and the last solution is the initial guess.
  /// \param verified  calls verify(), which takes about a third of the time of a solve
  const Solution& solveAgain(bool verified = true);
  /// Judges the last solution as judge() does, but keeps the factors: undetermined motions, errors, verdict, extremes.
  const Solution& verify();
  /// Accepts the last solution as the end of a step: with friction, slip continues from there. No effect without friction.
  void advance();
  /// Displacements of the surface's nodes in the last solution, ordered as the forces; zero before the first solution [length]. Local.
  std::vector<double> displacements(const CouplingSurface& surface) const;

  const Scene& scene() const { return scene_; }
  const Mesh& mesh() const { return mesh_; }                                ///< on rank 0, from read() to prepare()
  const Constraints& constraints() const { return constraints_; }           ///< likewise
  const std::vector<SubdomainMesh>& meshes() const { return cut_.meshes; }  ///< subdomains of this rank, after cut()
  const std::string& meshHash() const { return cut_.whole.hash; }           ///< on rank 0, after cut()
  const ProblemSize& size() const { return size_; }                         ///< after prepare()
  double megabytes() const { return megabytes_; }                           ///< memory for all ranks, estimated; after check()
  const Solution& solution() const;                                         ///< after iterate()
  ExitCode ending() const;                                                  ///< after judge()

 private:
  struct Silence {
    RunMonitor monitor{nullptr, false};
    Timers timers;
  };
  Simulation(const CommPtr& comm, Scene scene, std::unique_ptr<Silence> silence);
  void cutScene();
  void checkScene();
  void prepareMethod();
  void judgeSolution();
  Method::Keep checkpoints();
  void writeState(const Solution& solution) const;
  std::unique_ptr<Method> preparedMethod();
  void judge(Solution& solution, const Subdomains& subdomains);
  Run run(const Solution& solution, const Invocation& invocation = {}) const;
  Load& loadOf(const CouplingSurface& surface, const std::string& function);

  bool followsPath() const { return !scene_.steps.empty() && path_ && !scene_.isOneStep; }
  bool isCoupled() const { return scene_.steps.empty() && path_; }
  std::string inWords(const Overlap& overlap, bool drawn) const;
  void noteOverlaps();
  void followPath();
  Solution solveFrom(const Solution* before, bool isPrepared);
  Solution solveStep(const Solution* before, bool isPrepared);
  std::string lastStates() const;
  void goOnFromStart(Solution& before);
  void acceptStep(Solution& solution, const Solution* before, StepRow row);

  CommPtr comm_;
  Scene scene_;
  std::unique_ptr<Silence> silence_;
  RunMonitor& monitor_;
  Timers& timers_;
  std::string folder_;
  std::unique_ptr<const RunFolder> output_;  // null: no files are written
  std::unique_ptr<Method> method_;
  bool isWhole_;  // rank 0 holds the whole mesh until prepare()
  Mesh mesh_;
  Constraints constraints_;
  CutMesh cut_;
  ProblemSize size_;
  double megabytes_ = 0.0;
  double liftWork_ = 0.0;  // work of the loads in the motions removed, missing in the method's energies
  std::optional<Start> start_;
  std::unique_ptr<LoadPath> path_;    // null: neither load steps nor coupling
  std::unique_ptr<WorkMeter> meter_;  // on a path
  std::unique_ptr<const OverlapSearch> overlapSearch_;
  std::vector<Overlap> drawnOverlaps_;
  Doubts doubts_;           // doubts about the load steps
  std::string unfinished_;  // why the path ended early; empty: it did not
  bool brokeDown_ = false;  // the last trial of a step left no solution
  PathState restart_;       // path of a checkpoint, until it is continued
  Solution solution_;
  StageOrder order_;
  bool isJudged_ = false;  // by solveAgain()
};

}  // namespace suture
