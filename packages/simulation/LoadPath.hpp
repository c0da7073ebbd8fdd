#pragma once
#include <suture/constraints/LoadSteps.hpp>
#include <suture/constraints/PrescribedParts.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/Solution.hpp>

#include <map>
#include <vector>

namespace suture {

/// A scene on its path of load steps: what its loads, prescribed displacements and pairs are at a time, the histories of the pairs, and
/// what the steps so far have come to.
class LoadPath {
 public:
  /// \param parts  on rank 0. Collective.
  LoadPath(const Comm& comm, const LoadSteps& steps, const PrescribedParts& parts);

  /// Sets factors of the loads, values of the rules, and gaps and histories of the pairs to those of a step that ends at a time.
  /// \param constraints  the same for a method that needs the whole mesh; may be empty. Local.
  void setTime(double time, ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints) const;

  /// The next step begins where a solution ended. \param pairs  of the solution, on rank 0;  \param forces  that act on each body then, or
  /// empty. Collective.
  void accept(const std::vector<PairResult>& pairs, const std::vector<BodyForces>& forces);
  /// Goes on from a checkpoint.
  void goOnFrom(PathState state);
  /// For a checkpoint.
  PathState state(const std::vector<PairResult>& pairs) const;

  const LoadSteps& steps() const { return steps_; }
  /// Largest forces on each body, of the steps so far; empty: not known.
  const std::vector<BodyForces>& carried() const { return carried_; }
  double time() const { return rows.empty() ? 0.0 : rows.back().time; }

  std::vector<StepRow> rows;  ///< rows of the steps so far
  double length = 0.0;        ///< length of the next step

 private:
  const Comm& comm_;
  const LoadSteps& steps_;
  PrescribedParts parts_;
  std::map<int, ContactPair::Past> past_;  // by id, of pairs that have one
  std::vector<BodyForces> carried_;
};

/// Pairs whose status differs between the ends of two steps. On rank 0.
int changedPairs(const std::vector<PairResult>& before, const std::vector<PairResult>& now);

}  // namespace suture
