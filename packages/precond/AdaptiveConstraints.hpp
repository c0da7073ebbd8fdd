#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <vector>

namespace suture {

struct EntitySide;

/// Constraints that follow the coefficients (Mandel and Sousedik, 2007; Pechstein and Dohrmann, 2017): for each entity the eigenvectors of
///     sum_i P_i^T S_i P_i y = value E y
/// whose value is above the threshold. y are jumps between the traces of the sharers that vanish at the unknowns that are primal alone; S_i
/// is the entity's block of a sharer's Schur complement, P_i y the part of the jumps that averaging leaves on sharer i, and E y.y the
/// minimal energy of the sharers with these jumps. For two sharers
///     (D_2^T S_1 D_2 + D_1^T S_2 D_1) y = value (T_1 : T_2) y,      A : B = A (A + B)^-1 B,
/// with T_i the Schur complement onto the entity and the unknowns that are alone. Averaging makes these jumps most expensive relative to
/// the energy of the sharers; without them the condition number stays below a constant times the threshold, independent of the
/// coefficients. An eigenvector costs one constraint for two sharers, k - 1 for k. Cost: S_i as a matrix, and a dense eigenproblem per
/// entity. Vertices and ends of edges are primal alone.
class AdaptiveConstraints : public PrimalConstraints {
 public:
  static Schema schema();
  explicit AdaptiveConstraints(double threshold) : threshold_(threshold) {}
  bool isAdaptive() const override { return true; }

 protected:
  /// \throws InputError  if the threshold would select most of the interface.
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  void refuseTooMany(const InterfaceSpace& space, const std::vector<EntitySide>& sides, const PrimalChoice& choice) const;

  double threshold_;
};

}  // namespace suture
