#pragma once
#include <suture/answer/Doubts.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/StepSolver.hpp>

#include <string>
#include <vector>

namespace suture {

/// Solves a scene load step by load step: each step starts from the previous one, is verified, and is halved if it fails or changes too
/// many pairs. Its fields and a checkpoint are written.
class PathFollower {
 public:
  /// The first two arguments must outlive it. \param restart  path of a checkpoint whose solution is the start of the solver; empty: none
  PathFollower(SceneParts& parts, StepSolver& solver, PathState restart);

  /// The solution of the last step that was completed. Collective. \throws NumericalError  the first step left no solution
  Solution follow();

  /// Reason why the path ended early; empty: it did not.
  const std::string& unfinished() const { return unfinished_; }
  /// Doubts about the steps.
  const Doubts& doubts() const { return doubts_; }

 private:
  Solution solveStep(const Solution* before, bool isPrepared, double time);
  double continues(double time) const;
  std::string lastStates() const;
  void goOnFromStart(Solution& before);
  void acceptStep(Solution& solution, const Solution* before, StepRow row);

  const Comm& comm() const { return parts_.run.comm(); }
  RunMonitor& monitor() const { return parts_.run.monitor(); }
  Timers& timers() const { return parts_.run.timers(); }
  Scene& scene() const { return parts_.scene; }
  LoadPath& path() const { return *parts_.path; }

  SceneParts& parts_;
  StepSolver& solver_;
  PathState restart_;
  WorkMeter meter_;
  Doubts doubts_;
  std::string unfinished_;
  bool brokeDown_ = false;          // the last trial of a step left no solution
  std::vector<Vector> lastChange_;  // displacements of the last step
  double lastBegin_ = -1.0;         // time at which it began; negative: there was none
};

}  // namespace suture
