#pragma once
#include <suture/answer/verdict/Verify.hpp>

#include <utility>
#include <vector>

namespace suture {

/// Work on a path of load steps, starting from the undeformed bodies; within a step forces change linearly with the displacements. Loads
/// keep their directions, forces of prescribed motions turn with the bodies, which turn uniformly. [energy]
struct PathWork {
  double external = 0.0;    ///< work of loads and prescribed displacements
  double stored = 0.0;      ///< u.K u / 2, including elastic supports
  double normal = 0.0;      ///< work absorbed by normal contact forces of pairs that open or close: tends to zero for short steps
  double tangential = 0.0;  ///< work absorbed by tangential contact forces
  double dissipated = 0.0;  ///< work of friction as in PairResult: force at the end of each step times the slip of the step
  double size = 0.0;        ///< sum over the steps of the magnitudes of the works of loads, and of prescribed motions

  /// Work that is neither stored nor absorbed by contact, relative to `size`: lack of equilibrium along the path.
  double imbalance() const;
  /// Effect of the step length, relative to `size`: work terms that would vanish or agree for short steps.
  double stepError() const;
};

/// Adds up the work step by step, by loops over elements, loads and pairs like those of verify().
class WorkMeter {
 public:
  /// `comm` and the meshes of all solutions must outlive this object.
  explicit WorkMeter(const Comm& comm) : comm_(comm) {}
  /// Continues from a solution. \param soFar  work up to it. Collective.
  void goOnFrom(const Answer& answer, const PathWork& soFar);
  /// Adds the step that ends with a solution, under the loads of its model. Collective.
  void add(const Answer& answer);
  const PathWork& work() const { return work_; }

 private:
  /// External forces and displacements at the end of a step, of the nodes that this rank counts.
  struct End {
    std::vector<Matrix> load, held, displacement;  // by mesh: dimension x nodes; held: forces of prescribed motions
    std::vector<Matrix> turn;                      // by mesh: rotation from the drawn body
    std::vector<PairResult> pairs;                 // on rank 0
    double stored = 0.0;
  };
  End endOf(const Answer& answer) const;
  std::pair<double, double> externalWork(const End& now) const;

  const Comm& comm_;
  End before_;
  PathWork work_;
};

}  // namespace suture
