#pragma once
#include <suture/elasticity/ElementMap.hpp>

#include <Eigen/Core>

namespace suture {

/// The dilatation of one element, div u (with the hoop strain in axisymmetric blocks), projected in L2 onto the element's pressures; the
/// Lame constant lambda of a Mixed element acts on this projection. The displacement-pressure form with the pressure p = lambda x
/// projection eliminated is K = (terms of mu) + lambda C^T M^-1 C, M the mass matrix of the pressures and C their product with the
/// dilatation.
///
/// lambda is used rather than the bulk modulus: the rest, 2 mu e : e, is then definite up to rigid motions. With the deviatoric strain
/// instead, bending of an axisymmetric plate one element thick (e = z I) would have no energy in elements of constant pressure.
///
/// Pressures: constant, except linear in Quadrilateral9 and Hexahedron27 (the stable pairs Q1/P0 - stable except for its checkerboard
/// modes, which are eliminated here -, Q2/P-1, P2/P0; see Boffi, Brezzi, Fortin, "Mixed Finite Element Methods and Applications", 2013, ch.
/// 8). The linear pressures are functions of the mesh coordinates, because functions of the reference coordinates lose an order on
/// distorted cells (Arnold, Boffi, Falk 2002). \tparam D  dimension
template <int D>
class MixedPressure {
 public:
  /// Computes everything: moves `map` through the points of the rule of `reference`.
  MixedPressure(Cell cell, const ReferenceElement& reference, ElementMap<D>& map);

  /// K += lambda C^T M^-1 C, upper triangle.
  template <typename ElementMatrix>
  void addStiffness(double lambda, ElementMatrix& k) const {
    const int n = static_cast<int>(rows_.cols());
    for (int j = 0; j < n; ++j)
      for (int i = 0; i <= j; ++i) k(i, j) += lambda * rows_.col(i).dot(rows_.col(j));
  }
  static constexpr int most = D + 1;
  /// Coefficients of a function's projection onto the pressures, in the orthonormal basis.
  using Projection = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most, 1>;
  /// \param function  its value at the map's point; other arguments as in the constructor
  template <typename Function>
  Projection projection(const ReferenceElement& reference, ElementMap<D>& map, const Function& function) const {
    Projection moments = Projection::Zero(count_);
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      moments += (map.measure() * function(map.place())) * basisAt(map.place());
    }
    root_.template triangularView<Eigen::Lower>().solveInPlace(moments);
    return moments;
  }
  double at(const Projection& function, const Point& place) const {
    return basisAt(place).dot(root_.transpose().template triangularView<Eigen::Upper>().solve(function));
  }
  /// Integral of the projected dilatation of each unit displacement times a function.
  double work(const Projection& function, int dof) const { return rows_.col(dof).dot(function); }
  /// Addition to the diagonal of K per unit of lambda.
  double diagonal(int dof) const { return rows_.col(dof).squaredNorm(); }
  /// Projected dilatation at a point, for displacements of the element's nodes (node-major).
  template <typename Displacement>
  double dilatation(const Displacement& u, const Point& place) const {
    return at(rows_ * u, place);
  }

 private:
  Projection basisAt(const Point& place) const;

  int count_;
  Point centre_{0, 0, 0};
  double size_ = 1.0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most> root_;              // L of M = L L^T
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, D * mostNodes<D>> rows_;  // L^-1 C
};

}  // namespace suture
