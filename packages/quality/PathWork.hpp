#pragma once
#include <suture/quality/Verify.hpp>

#include <vector>

namespace suture {

/// Work on a path of load steps, from the undeformed bodies on; between the ends of a step forces change linearly with the displacements.
/// [energy]
struct PathWork {
  double external = 0.0;    ///< work of loads and prescribed displacements
  double stored = 0.0;      ///< u.K u / 2, elastic supports included
  double normal = 0.0;      ///< work that normal contact forces have taken, of pairs that open or close: none if steps are short
  double tangential = 0.0;  ///< work that tangential contact forces have taken
  double dissipated = 0.0;  ///< work of friction as PairResult has it: the force at the end of each step times the step's slip
  double size = 0.0;        ///< sum of the magnitudes of the steps' works

  /// Work that is neither stored nor taken by contact, relative to the size: what equilibrium lacks on the way.
  double imbalance() const;
  /// Effect of the length of the steps: works that would vanish, or agree, if they were short, relative to the size.
  double stepError() const;
};

/// Adds the work of one step after the other, by loops over elements, loads and pairs, as verify() judges an answer.
class WorkMeter {
 public:
  /// `comm` and the meshes of all answers outlive it.
  explicit WorkMeter(const Comm& comm) : comm_(comm) {}
  /// Goes on from an answer. \param soFar  work up to it. Collective.
  void goOnFrom(const Answer& answer, const PathWork& soFar);
  /// Adds the step that ends with an answer, under the loads of the answer's model. Collective.
  void add(const Answer& answer);
  const PathWork& work() const { return work_; }

 private:
  /// External forces and displacements at the end of a step, of the nodes that this rank counts.
  struct End {
    std::vector<Matrix> force, displacement;  // by mesh: dimension x nodes
    std::vector<PairResult> pairs;            // on rank 0
    double stored = 0.0;
  };
  End endOf(const Answer& answer) const;

  const Comm& comm_;
  End before_;
  PathWork work_;
};

}  // namespace suture
