#pragma once
#include <suture/answer/Doubts.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/Invocation.hpp>
#include <suture/report/answers/ProbeValues.hpp>
#include <suture/simulation/OverlapNotes.hpp>
#include <suture/simulation/SceneParts.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

// The stages from a scene to its verified solution. Each stage takes the result of the previous one, which it uses up: another order does
// not compile.
//
//     JudgedScene judged = refine(judge(solve(prepare(check(cut(read(run, scene)))))));
//
// All functions are collective, except const members. Only the monitor of the run prints, and files are written only after
// RunContext::writeInto(). Errors of any kind are the same on all ranks.

/// How a run ended.
struct RunResult {
  ExitCode code = ExitCode::Done;
  std::string failure = {};  ///< reason if the run did not converge
  std::string summary = {};  ///< text of summary.json, on rank 0; empty if nothing was written
};

/// A scene with its whole mesh and constraints on rank 0, if a later stage needs them.
class MeshedScene {
 public:
  const Mesh& mesh() const { return parts_->mesh; }                       ///< on rank 0
  const Constraints& constraints() const { return parts_->constraints; }  ///< likewise

 private:
  static MeshedScene of(std::unique_ptr<SceneParts> parts);
  friend MeshedScene read(RunContext run, Scene scene);
  friend class PreparedScene;
  friend class PartitionedScene;
  std::unique_ptr<SceneParts> parts_;
  std::unique_ptr<Method> method_;
};

/// Reads mesh and constraints.
MeshedScene read(RunContext run, Scene scene);

/// A scene as subdomains on their ranks, with their loads.
class PartitionedScene {
 public:
  const Scene& scene() const { return parts_->scene; }
  const std::vector<SubdomainMesh>& meshes() const { return parts_->cut.meshes; }  ///< subdomains of this rank
  std::string meshHash() const { return parts_->meshHash(); }                      ///< on rank 0

 private:
  friend PartitionedScene cut(MeshedScene meshed);
  friend class CheckedScene check(PartitionedScene scene);
  friend class CheckedScene;
  friend class CoupledScene;
  friend class PreparedScene;
  explicit PartitionedScene(MeshedScene meshed) : parts_(std::move(meshed.parts_)), method_(std::move(meshed.method_)) {}
  std::unique_ptr<SceneParts> parts_;
  std::unique_ptr<Method> method_;
};

/// Creates the subdomains.
PartitionedScene cut(MeshedScene meshed);

/// A scene that can be solved, as far as is known before its solution.
class CheckedScene {
 private:
  friend CheckedScene check(PartitionedScene scene);
  friend class PreparedScene;
  CheckedScene(PartitionedScene scene, OverlapNotes overlaps)
      : parts_(std::move(scene.parts_)), method_(std::move(scene.method_)), overlaps_(std::move(overlaps)) {}
  std::unique_ptr<SceneParts> parts_;
  std::unique_ptr<Method> method_;
  OverlapNotes overlaps_;
};

/// Refuses elements that lock, scenes without a solution, exact solutions without a value, probes outside the bodies, and runs that exceed
/// the memory.
CheckedScene check(PartitionedScene scene);

/// A scene whose method is assembled and factored.
class PreparedScene {
 public:
  const Scene& scene() const { return parts_->scene; }
  const std::vector<SubdomainMesh>& meshes() const { return parts_->cut.meshes; }  ///< subdomains of this rank
  const ProblemSize& size() const { return parts_->size; }
  double megabytes() const { return parts_->megabytes; }  ///< memory for all ranks, estimated
  /// Adds notes on the partition and on the settings to the monitor.
  void remark() const;
  /// Sets the initial guess: the checkpoint of an earlier run on this mesh, or, if `restart` is empty, a nested start from Scene::levels.
  void startFrom(const std::string& restart);
  /// Sets another initial guess.
  void startFrom(Start start) { start_ = std::move(start); }

 private:
  friend PreparedScene prepare(CheckedScene checked);
  friend class SolvedScene solve(PreparedScene prepared);
  friend class SolvedScene;
  friend class CoupledScene;
  explicit PreparedScene(CheckedScene checked)
      : parts_(std::move(checked.parts_)), method_(std::move(checked.method_)), overlaps_(std::move(checked.overlaps_)) {}
  static PreparedScene nextPhase(const SceneParts& parts, const Solution& solution);
  void prepareMethod();
  void adopt(PreparedScene other);
  void goOnInPhase(const std::string& restart);
  std::unique_ptr<SceneParts> parts_;
  std::unique_ptr<Method> method_;
  std::optional<OverlapNotes> overlaps_;
  std::optional<Start> start_;
  PathState restart_;  // path of a checkpoint
};

/// Finds the amounts of controlled loads, removes prescribed rigid motions from the scene, assembles and factors.
PreparedScene prepare(CheckedScene checked);

/// A scene with its solution, which may not have converged. With load steps, each step has been verified.
class SolvedScene {
 public:
  const std::vector<SubdomainMesh>& meshes() const { return parts_->cut.meshes; }  ///< subdomains of this rank
  const ProblemSize& size() const { return parts_->size; }
  const Solution& solution() const { return solution_; }

 private:
  friend SolvedScene solve(PreparedScene prepared);
  friend class JudgedScene judge(SolvedScene solved);
  friend class JudgedScene;
  explicit SolvedScene(PreparedScene prepared)
      : parts_(std::move(prepared.parts_)), method_(std::move(prepared.method_)), overlaps_(std::move(prepared.overlaps_)) {}
  void solveAtOnce(const std::optional<Start>& start);
  void followPath(std::optional<Start> start, PathState restart);
  PathState enterNextPhase(std::optional<Start>& start);
  std::unique_ptr<SceneParts> parts_;
  std::unique_ptr<Method> method_;
  std::optional<OverlapNotes> overlaps_;
  Solution solution_;
  Doubts doubts_;           // doubts about the load steps
  std::string unfinished_;  // reason why the path ended early; empty: it did not
  bool isJudged_ = false;
};

/// Solves. With load steps, each step is verified, and its fields and a checkpoint are written.
SolvedScene solve(PreparedScene prepared);

/// A scene with its verified solution; all factors are freed.
class JudgedScene {
 public:
  const RunContext& run() const { return parts_->run; }
  const Scene& scene() const { return parts_->scene; }
  const std::vector<SubdomainMesh>& meshes() const { return parts_->cut.meshes; }  ///< subdomains of this rank
  const ProblemSize& size() const { return parts_->size; }
  const Solution& solution() const { return solution_; }
  /// After refine(), of a scene with a request for accuracy; else nothing.
  const std::optional<AccuracyReached>& accuracy() const { return accuracy_; }
  ExitCode ending() const;
  /// Text of summary.json on rank 0, empty on other ranks. Writes no file. Collective. \param invocation  for the record
  std::string summary(const Invocation& invocation = {}) const;
  /// Writes the results, and the last lines of the console. Collective. \param invocation  for the record
  /// \throws InternalError  the run has no output folder
  RunResult report(const Invocation& invocation = {}) const;

  /// Writes the results into another folder than that of the run, without output to the console. With load steps, only the fields of the
  /// last step exist. Collective. \throws EnvironmentError
  void writeTo(const std::string& folder) const;
  /// Recovered stresses at the nodes of each subdomain of this rank: nodes x components; NaN for user-defined subdomains. Those of the
  /// solution, or computed now. Collective.
  std::vector<Matrix> nodalStresses() const;
  /// Probes of the scene, `Output/Probes`. Local.
  std::vector<Probe> probes() const;
  /// Values at probes, on rank 0: see probeValues(). Collective. \throws InputError
  std::vector<std::vector<ProbeValue>> valuesAt(const std::vector<Probe>& probes, const std::vector<Matrix>& nodal) const;

 private:
  friend JudgedScene judge(SolvedScene solved);
  friend JudgedScene refine(JudgedScene judged);
  friend class AdaptiveLevels;
  explicit JudgedScene(SolvedScene solved)
      : parts_(std::move(solved.parts_)), solution_(std::move(solved.solution_)), unfinished_(std::move(solved.unfinished_)) {}
  Run asRun(const Invocation& invocation = {}) const;
  std::unique_ptr<SceneParts> parts_;
  Solution solution_;
  std::string unfinished_;
  std::optional<AccuracyReached> accuracy_;
};

/// Settles undetermined motions, computes errors and verifies the solution.
JudgedScene judge(SolvedScene solved);

/// With a request for accuracy (Scene::accuracy): solves the scene on finer and finer meshes until the error is small enough, or a limit is
/// reached (AccuracyReached), and returns the answer on the last mesh. Otherwise returns the argument.
/// \throws Error  of any stage, on any mesh
JudgedScene refine(JudgedScene judged);

/// Exit code of a verified solution. \param unfinished  reason why a path ended early, or empty
ExitCode endingOf(const Solution& solution, const std::string& unfinished = "");

}  // namespace suture
