#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Functions psi_j on part of a side that are biorthogonal to its shape functions chi_k over this part,
///     int psi_j chi_k = delta_jk int chi_k,
/// as combinations of the chi_k: psi = D M^-1 chi, M the mass matrix, D the diagonal matrix of the integrals of chi. The psi_j sum to one.
/// For dual mortar methods (Wohlmuth 2000; on partly covered sides as in Cichosz and Bischoff 2011), 2D and 3D. Local.
class DualBasis {
 public:
  /// \param shapes  functions x points: the chi_k at the points of a quadrature that is exact for their products
  /// \param weights  of the points [length or area]
  /// \param distinct  if the pivots of M have a smaller ratio, the part is so small or slender that the chi_k are nearly linearly
  /// dependent: psi_j is then the constant with the same integral, and the sum remains one
  DualBasis(const Matrix& shapes, const Vector& weights, double distinct = 0.0);

  /// Values of all psi_j at a point, given the values of the shape functions there.
  Vector at(const Vector& shapes) const { return dual_ * shapes; }

 private:
  Matrix dual_;
};

}  // namespace suture
