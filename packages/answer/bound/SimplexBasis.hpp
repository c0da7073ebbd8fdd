#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Lagrange basis of degree 1 or 2 on a simplex of dimension S, as functions of barycentric coordinates. Nodes: the vertices, then with
/// degree 2 the middles of the edges (0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3), as far as their vertices exist. Local.
template <int S>
class SimplexBasis {
 public:
  using Barycentric = Eigen::Matrix<double, S + 1, 1>;
  static constexpr int nodes(int degree) { return degree == 1 ? S + 1 : (S + 1) * (S + 2) / 2; }

  /// \param degree  1 or 2
  explicit SimplexBasis(int degree);

  int nodes() const { return int(places_.cols()); }
  Barycentric place(int node) const { return places_.col(node); }
  /// Values at a point: nodes().
  Vector values(const Barycentric& point) const;
  /// Derivatives with respect to barycentric coordinates, regarded as independent: nodes() x (S + 1).
  Matrix derivatives(const Barycentric& point) const;
  /// Mean values of the products of two functions over the simplex: nodes() x nodes().
  Matrix mass() const;
  /// Mean values of the functions.
  Vector means() const { return mass().rowwise().sum(); }

 private:
  int degree_;
  Eigen::Matrix<double, S + 1, Eigen::Dynamic> places_;
};

}  // namespace suture
