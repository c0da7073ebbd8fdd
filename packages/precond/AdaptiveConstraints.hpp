#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <vector>

namespace suture {

struct EntitySide;

/// Constraints that follow the coefficients (Mandel and Sousedik, 2007; Pechstein and Dohrmann, 2017): on each entity the eigenvectors of
///     sum_i P_i^T S_i P_i y = value E y
/// whose value is above the threshold. y are jumps between the traces of the sharers that vanish at the unknowns which are primal alone,
/// S_i the entity's block of a sharer's Schur complement, P_i y what averaging leaves of the jumps on sharer i, and E y.y the least energy
/// of the sharers with these jumps. For two sharers
///     (D_2^T S_1 D_2 + D_1^T S_2 D_1) y = value (T_1 : T_2) y,      A : B = A (A + B)^-1 B,
/// T_i the Schur complement onto the entity and the unknowns that are alone. These jumps are those that averaging makes most expensive
/// compared with the energy of the sharers; without them the condition stays below a constant times the threshold, whatever the
/// coefficients. An eigenvector costs one constraint for two sharers, k - 1 for k. Cost: S_i as a matrix, and dense eigenproblems of the
/// entities. Vertices and ends of edges are primal alone.
class AdaptiveConstraints : public PrimalConstraints {
 public:
  static Schema schema();
  explicit AdaptiveConstraints(double threshold) : threshold_(threshold) {}
  bool isAdaptive() const override { return true; }

 protected:
  /// \throws InputError  the threshold would choose most of the interface.
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  void refuseTooMany(const InterfaceSpace& space, const std::vector<EntitySide>& sides, const PrimalChoice& choice) const;

  double threshold_;
};

}  // namespace suture
