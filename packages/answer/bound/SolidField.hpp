#pragma once
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

#include <functional>

namespace suture {

/// The displacement of a hexahedron, wedge or pyramid: an affine function A, and a rest r. Energies and works of both in the cell.
///
/// Integrals have Gauss points in each direction of the cube that is mapped to the reference cell (collapsed for wedges and pyramids). They
/// are exact for affine maps. On others the determinant of the map is in the denominator. It has degree 2 in each direction; with k the
/// largest over the least of its Bernstein coefficients, its zeros are outside the ellipse with the foci -1 and 1 and the sum of semi-axes
/// R (rateOf), and n points leave a relative error of about R^(-2n). n is chosen for 1e-6, and 1e-4 of the energy of r is added. Local.
class SolidField {
 public:
  using Nodal = BoundedField<3>::Forces;

  /// All arguments must outlive this object.
  SolidField(const CellBlock& block, int element);

  /// False: a map that is not that of the vertices.
  bool isCurved() const { return isCurved_; }
  /// False: the cell is too distorted for the integrals.
  bool isAccurate() const { return points_ <= kMostPoints; }
  double volume() const { return volume_; }
  /// Displacements at the nodes, split into A = mean + slope (x - centre()), and r.
  void set(const Nodal& displacement);
  const Nodal& rest() const { return rest_; }
  const Eigen::Matrix3d& slope() const { return slope_; }
  Eigen::Vector3d affineAt(const Eigen::Vector3d& place) const { return mean_ + slope_ * (place - centre_); }
  /// r where the map has a place; false if it is not found.
  bool restAt(const Eigen::Vector3d& place, const Eigen::Vector3d& guess, Eigen::Vector3d& value) const;
  Eigen::Vector3d referenceOf(int node) const;

  struct Integrals {
    Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();  ///< strain of r, integrated
    double square = 0.0;                                                       ///< a(r, r) [energy]
    double work = 0.0;                                                         ///< work of the body force in r [energy]
    double affineWork = 0.0;                                                   ///< its work in A [energy]
    double error = 0.0;                                                        ///< largest error of square - 2 work
  };
  /// \param source  body force; none: zero
  Integrals integrals(const Eigen::Matrix<double, 6, 6>& stiffness, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& source);

 private:
  static constexpr int kMostPoints = 32;
  void findCurved();
  void findAffinity();
  int pointsFor() const;

  const CellBlock& block_;
  int element_;
  Cell cell_;
  Nodal places_;
  bool isCurved_ = false, isAffine_ = false;
  int points_ = 0;  // per direction
  Eigen::Vector3d centre_, mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inverse_;  // inverse of the Jacobian at the centre
  std::vector<double> gradients_, values_;
  Eigen::Matrix3d slope_ = Eigen::Matrix3d::Zero();
  Nodal rest_;
  double volume_ = 0.0;
};

/// Sum R of the semi-axes of an ellipse with the foci -1 and 1 without zeros of any polynomial of degree 2 whose Bernstein coefficients on
/// [-1, 1] are positive and differ by at most the factor k. With z = (1 + t) / (1 - t), R = |(sqrt z + i) / (sqrt z - i)| at a zero z; real
/// zeros have |z| <= k + sqrt(k^2 - 1), complex ones |z| <= sqrt k and cos(arg z) <= -1 / k. Local.
double rateOf(double k);

}  // namespace suture
