#pragma once
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace suture {

/// Solves the load steps of a path, one after the other; a step may be tried again with another length.
class StepSolver {
 public:
  virtual ~StepSolver() = default;
  /// The solution for the present loads. Collective.
  /// \param before        solution of the last accepted step, the initial guess; null: the start
  /// \param isPrepared    the method is prepared for these loads
  /// \param displacement  better initial displacements of each subdomain than those of `before`; null: none
  /// \param continues  change of all loads in units of that in the last step; zero: they do not continue like this
  virtual Solution solve(const Solution* before, bool isPrepared, const std::vector<Vector>* displacement = nullptr,
                         double continues = 0.0) = 0;
  /// Adds checks that only this solver can make to the verdict on its last solution. Collective.
  virtual void verify(Solution& solution) const { (void)solution; }
  /// True if the last solution moved so far that a shorter step is more accurate. Collective.
  virtual bool isTooLong(const Solution& solution) const { return (void)solution, false; }
  /// Places of the bodies at the last solution, on rank 0; empty if they do not move far.
  virtual std::vector<StepRow::Frame> frames() const { return {}; }
  /// Makes a solution the state from which the next step starts. Collective.
  virtual void accept(const Solution& solution) { (void)solution; }
  /// Makes the scene that of the last accepted step again, after a trial that failed. \param last  its solution. Collective.
  virtual void restore(Solution& last) { (void)last; }
  /// True if the pairs of two steps, and their displacements, can be compared.
  virtual bool keepsPairs() const { return true; }

  virtual const Method& method() const = 0;
  /// Hands the method over; no solution afterwards.
  virtual std::unique_ptr<Method> takeMethod() = 0;
  /// Goes on from a checkpoint: the solution of its last step, as far as the next step needs it. Before solve(). Collective.
  /// \throws InputError  the checkpoint lacks something
  virtual Solution goOnFrom(const PathState& state) = 0;
};

}  // namespace suture
