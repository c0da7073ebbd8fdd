#pragma once
#include <suture/base/Errors.hpp>
#include <suture/quality/Doubts.hpp>
#include <suture/quality/Overlaps.hpp>
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
  std::string failure = {};  ///< why it did not converge
  std::string summary = {};  ///< on rank 0: the text of summary.json; empty if nothing was written
};

/// The whole way from a scene to its answer. solve() goes it in one call:
///
///     const Solution solution = Simulation(comm, scene).solve();
///
/// Programs that do something between the stages call these one by one, in the order in which they stand here: read(), cut(), check(),
/// prepare(), iterate(), judge(), each of them once; another order is an InternalError. Nothing is printed but what a monitor prints, and
/// nothing is written without writeInto(). All functions are collective, but for those that return what is known.
/// \throws Error  of any kind, the same on all ranks
class Simulation {
 public:
  /// Silent.
  Simulation(const CommPtr& comm, Scene scene);
  /// \param monitor, timers  must outlive it
  Simulation(const CommPtr& comm, Scene scene, RunMonitor& monitor, Timers& timers);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Takes an output folder and locks it: the files of a run go there, and checkpoints while it solves, if the settings ask for them.
  /// \throws EnvironmentError
  void writeInto(const std::string& folder);

  /// All stages but report(). Called again, it returns the same solution.
  const Solution& solve();

  /// Mesh and constraints, if a later stage needs them whole.
  void read();
  /// Subdomains on their ranks, and what loads are on them.
  void cut();
  /// Refuses elements that lock, scenes without a solution, exact solutions without a value, probes outside the
  /// bodies, runs larger than the memory.
  void check();
  /// Finds the amounts of controlled loads, takes rigid motions out of the scene, assembles and factors.
  void prepare();
  /// Notes for the user on the cut and on the settings.
  void remark();
  /// Finds where to begin: the checkpoint of an earlier run of this mesh, or, if `restart` is empty, the answers of the scene's levels.
  void start(const std::string& restart = "");
  /// Begins there instead.
  void startFrom(Start start);
  /// Solves; a scene with load steps step after step, each of them judged, its fields and a checkpoint written.
  void iterate();
  /// Settles what the solution leaves free, measures its errors, verifies it. The last stage that computes: it frees what was factored.
  void judge();
  /// Writes the results, and the last lines of the monitor's console.
  /// \param invocation  for the record
  RunResult report(const Invocation& invocation = {});
  /// Text of summary.json on rank 0, elsewhere nothing; after judge(). Nothing is written.
  std::string summary(const Invocation& invocation = {}) const;

  /// Couples the scene to another program, which loads a side group or moves it, and changes that from solve to solve:
  ///
  ///     const CouplingSurface surface = simulation.coupling("block_top");
  ///     for (...) {
  ///       simulation.setForces(surface, forces);
  ///       simulation.solveAgain();
  ///       displacements = simulation.displacements(surface);
  ///     }
  ///
  /// Reads and cuts the scene, unless that was done. Before prepare(); for as many groups as there are. Rigid motions are not taken out of
  /// a coupled scene, as of one with load steps.
  /// \throws InputError  an unknown group (nearest name); a scene with load steps or controlled loads
  CouplingSurface coupling(const std::string& group);
  /// Forces on the surface's nodes from now on: nodes x dimension, node-major, Cartesian [force]; at first zero. They add to the loads of
  /// the scene. \throws InputError  a wrong number of values, or one that is not finite
  void setForces(const CouplingSurface& surface, const std::vector<double>& forces);
  /// The same from tractions at the nodes, interpolated by the shape functions [stress].
  void setTractions(const CouplingSurface& surface, const std::vector<double>& tractions);
  /// Displacements of the surface's nodes from now on, along the components that a condition of the scene prescribes there: others stay
  /// free [length]. \throws InputError  as for forces; nodes in a contact
  void setDisplacements(const CouplingSurface& surface, const std::vector<double>& displacements);
  /// Solves with the loads as they are now; the first time after all stages that come before. What was factored stays, but of methods that
  /// cannot reload (Condensed Groups, Monolithic), and the last answer is the start.
  /// \param verified  calls verify(), which takes about a third of the time of a solve
  const Solution& solveAgain(bool verified = true);
  /// Judges the last answer as judge() does, and keeps what was factored: motions that it leaves free, errors, verdict, extremes.
  const Solution& verify();
  /// Takes the last answer as the end of a step: with friction, pairs slip on from there. Without friction it changes nothing.
  void advance();
  /// Displacements of the surface's nodes at the last answer, in the order of forces; zero before it [length]. Local.
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
  std::unique_ptr<const RunFolder> output_;  // null: nothing is written
  std::unique_ptr<Method> method_;
  bool isWhole_;  // rank 0 holds the whole mesh until prepare()
  Mesh mesh_;
  Constraints constraints_;
  CutMesh cut_;
  ProblemSize size_;
  double megabytes_ = 0.0;
  double liftWork_ = 0.0;  // work of the loads in the motions taken out, which the method's energies lack
  std::optional<Start> start_;
  std::unique_ptr<LoadPath> path_;    // null: neither load steps nor a coupling
  std::unique_ptr<WorkMeter> meter_;  // on a path
  std::unique_ptr<const OverlapSearch> overlapSearch_;
  std::vector<Overlap> drawnOverlaps_;
  Doubts doubts_;           // on a path: of its steps
  std::string unfinished_;  // why the path ended before its end; empty: it did not
  bool brokeDown_ = false;  // the last trial of a step left nothing behind
  PathState restart_;       // path of a checkpoint, before it is taken up
  Solution solution_;
  StageOrder order_;
  bool isJudged_ = false;  // by solveAgain()
};

}  // namespace suture
