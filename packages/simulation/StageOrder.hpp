#pragma once
#include <functional>
#include <string>

namespace suture {

/// The order of a run's stages: records the last stage done and refuses stages that are skipped, repeated, or follow a failed one. A wrong
/// order is an InternalError, i.e. a bug of the calling program; it is the same on all ranks, because stages are collective.
class StageOrder {
 public:
  enum Stage { Nothing, Read, Cut, Checked, Prepared, Solved, Judged };

  bool has(Stage stage) const { return done_ >= stage; }

  /// Runs `work`, the stage that leads from `before` to `after`.
  /// \param function  that runs it, for messages
  /// \throws InternalError  the last stage done is not `before`; also any error of `work`, after which no further stage runs
  void make(Stage before, Stage after, const std::string& function, const std::function<void()>& work);

  /// Refuses a function unless the last stage done lies between `least` and `most`. \throws InternalError
  void require(Stage least, Stage most, const std::string& function) const;

  /// Records a stage that another function has run (Simulation::solveAgain()).
  void reach(Stage stage) { done_ = stage; }

 private:
  Stage done_ = Nothing;
  std::string failed_;  // function that threw
};

}  // namespace suture
