#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/constraints/PrescribedParts.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Steps.hpp>
#include <suture/simulation/Release.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// A scene during its load steps: loads, prescribed displacements and pairs at a given time, the histories of the pairs, and the results
/// of the steps so far.
class LoadPath {
 public:
  /// \param parts  on rank 0. Collective.
  LoadPath(const Comm& comm, const LoadSteps& steps, const PrescribedParts& parts);

  /// Sets load factors, rule values, and gaps and histories of the pairs for a step that ends at `time`.
  /// \param constraints  the same data for a method that needs the whole mesh; may be empty. Local.
  void setTime(double time, ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints);

  /// Makes a solution the start of the next step. \param pairs  of the solution, on rank 0;  \param forces  acting on each body at its end,
  /// or empty. Collective.
  void accept(const std::vector<PairResult>& pairs, const std::vector<BodyForces>& forces);
  /// Continues from a checkpoint.
  void goOnFrom(PathState state);
  /// State for a checkpoint.
  PathState state(const std::vector<PairResult>& pairs) const;

  /// Adds the forces by which removed parts held the others as a load that falls to zero. Local, the same on all ranks.
  void release(const Release& release, std::map<GlobalId, Point> forces, ElasticModel& model);
  /// How a load of the model is released; null: it is no load of removed parts.
  const Release* releaseOf(const Load& load) const;
  /// Factors of all loads and prescribed displacements at a time: those of the load steps, and the remaining fractions of removed parts.
  std::vector<double> factorsAt(double time) const;

  const LoadSteps& steps() const { return steps_; }
  /// Largest forces on each body over the steps so far; empty if unknown.
  const std::vector<BodyForces>& carried() const { return carried_; }
  /// Time of the last setTime().
  double presentTime() const { return presentTime_; }
  double time() const { return rows.empty() ? 0.0 : rows.back().time; }

  std::vector<StepRow> rows;                 ///< rows of the steps so far
  double length = 0.0;                       ///< length of the next step
  std::vector<LeastSafety> safety;           ///< least safety factors over the steps so far
  std::shared_ptr<const MovedBodies> moved;  ///< bodies that move far, at the end of the last step; null: there are none

 private:
  const Comm& comm_;
  const LoadSteps& steps_;
  PrescribedParts parts_;
  double presentTime_ = 0.0;
  std::map<int, ContactPair::Past> past_;  // by id, of pairs that have one
  std::vector<BodyForces> carried_;
  std::map<std::string, Release> releases_;  // by the name of the load
};

/// Pairs whose status differs between the ends of two steps; new ones do not count. On rank 0.
int changedPairs(const std::vector<PairResult>& before, const std::vector<PairResult>& now);
/// Those among them that change during a step, at a load that only shorter steps find: they open, close, or begin to slip. A pair that
/// stops slipping where a load reverses sticks from the beginning of the step. On rank 0.
int changedWithin(const std::vector<PairResult>& before, const std::vector<PairResult>& now);

}  // namespace suture
