#pragma once
#include <functional>
#include <string>

namespace suture {

/// The order of a run's stages: which one is done, and that none is left out, made twice, or made after one that failed. A wrong order is
/// an InternalError, a bug of the program that calls; it is the same on all ranks, because stages are collective.
class StageOrder {
 public:
  enum Stage { Nothing, Read, Cut, Checked, Prepared, Solved, Judged };

  bool has(Stage stage) const { return done_ >= stage; }

  /// Makes a stage: `work`, between the stages that stand next to each other in the order.
  /// \param function  that makes it, for messages
  /// \throws InternalError  another stage than `before` is the last that is done;  whatever `work` throws: no other stage is made then
  void make(Stage before, Stage after, const std::string& function, const std::function<void()>& work);

  /// Refuses a function where the last stage that is done is not between two. \throws InternalError
  void require(Stage least, Stage most, const std::string& function) const;

  /// A stage is done that another function has made (Simulation::solveAgain()).
  void reach(Stage stage) { done_ = stage; }

 private:
  Stage done_ = Nothing;
  std::string failed_;  // function that threw
};

}  // namespace suture
