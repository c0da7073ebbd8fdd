#pragma once
#include <suture/precond/EdgeConstraints.hpp>

namespace suture {

/// Edge constraints that follow the coefficients (Mandel and Sousedik, 2007; Pechstein and Dohrmann, 2017): on each edge the eigenvectors
/// of
///     (D_2^T S_1 D_2 + D_1^T S_2 D_1) v = value (T_1 : T_2) v,      A : B = A (A + B)^-1 B,
/// whose value is above the threshold; S_i is the edge's block of a side's Schur complement, T_i its Schur complement onto the edge and
/// the corners of both, for jumps that vanish at these. They are the jumps that averaging makes most expensive compared with the energy of
/// the sides; without them the condition stays below a constant times the threshold, whatever the coefficients. Cost: S_i as a matrix, and
/// dense eigenproblems of the edges.
class AdaptiveEdges : public EdgeConstraints {
 public:
  static Schema schema();
  explicit AdaptiveEdges(double threshold) : threshold_(threshold) {}
  /// \throws InputError  the threshold would choose most of the interface.
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;
  bool isAdaptive() const override { return true; }

 private:
  double threshold_;
};

}  // namespace suture
