#pragma once
#include <suture/answer/bound/CellParts.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

namespace suture {

/// Difference between a displacement u of a quadrilateral and its interpolant v on the two triangles.
struct InterpolantDifference {
  double functional = 0.0;  ///< 2 (J(u) - J(v)), J(.) = a(., .) / 2 - work of the loads in the cell, plus its largest error [energy]
  double square = 0.0;      ///< a(u, u) - a(v, v) [energy]
  bool isAccurate = true;   ///< false: the cell is too distorted for these integrals
};

/// Displacements of a quadrilateral, interpolated by polynomials of second order on its two triangles: equal on the edges of the cell if
/// they are straight, so that the interpolant is as continuous.
///
/// The differences are integrated after subtraction of one affine function from both, with Gauss points per direction of the reference
/// cell. On parallelograms the integrals are exact. On others the integrand has the determinant of the map in its denominator: with k the
/// largest over the least determinant at the vertices, n points leave a relative error of about R^(-2n), R = (sqrt(k) + 1) / (sqrt(k) - 1);
/// n is chosen for 1e-15, and 1e-13 is added; k above 200 would need too many points. Differences in cells that are no bilinear images are
/// not computed, and count as zero. Local.
class QuadrilateralField {
 public:
  using Stiffness = Eigen::Matrix3d;
  using Nodal = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 9>;  ///< displacements at the nodes of the cell

  /// All arguments must outlive this object. \param isCurved  it is not the bilinear image of the reference cell
  QuadrilateralField(const CellBlock& block, int element, const CellParts<2>& parts, bool isCurved);

  /// Sets the stresses of the simplices, which have places, sources and compliance, for a displacement. \param loaded  the sources are not
  /// zero
  InterpolantDifference set(const Nodal& displacement, const Stiffness& stiffness, bool loaded, BoundElement<2>* simplices) const;

 private:
  void findAffinity();
  void findSpread();
  Point newNode() const;
  int points() const;  // per direction
  InterpolantDifference inCell(const Nodal& rest, const Stiffness& stiffness, const BoundElement<2>* loaded) const;

  const CellBlock& block_;
  int element_;
  const CellParts<2>& parts_;
  bool isCurved_, isAffine_ = false;
  double spread_ = 1.0;     // largest over least determinant at the vertices
  Nodal places_;            // nodes of the cell
  Eigen::Vector2d centre_;  // image of the centre of the reference cell
  Eigen::Matrix2d slope_;   // inverse Jacobian there
};

}  // namespace suture
