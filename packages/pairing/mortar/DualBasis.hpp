#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Functions psi_j on a part of a side that are biorthogonal to its shape functions chi_k over this part,
///     int psi_j chi_k = delta_jk int chi_k,
/// and combinations of them: psi = D M^-1 chi, M the mass matrix, D the diagonal of the chi's integrals. Their sum is one. In the plane and
/// in space; for dual mortar methods (Wohlmuth 2000; over partly covered sides as Cichosz and Bischoff 2011). Local.
class DualBasis {
 public:
  /// \param shapes  functions x points: the chi_k at the points of a quadrature that is exact for their products
  /// \param weights  of the points [length or area]
  /// \param distinct  if the pivots of M have a smaller ratio, the part is so small or slender that the chi_k hardly differ from linearly
  ///                  dependent ones: psi_j is then the constant with the same integral, so that their sum stays one
  DualBasis(const Matrix& shapes, const Vector& weights, double distinct = 0.0);

  /// Values of all psi_j where the shape functions have these values.
  Vector at(const Vector& shapes) const { return dual_ * shapes; }

 private:
  Matrix dual_;
};

}  // namespace suture
