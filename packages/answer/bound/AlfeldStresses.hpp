#pragma once
#include <suture/answer/bound/SimplexBasis.hpp>

#include <array>
#include <vector>

namespace suture {

/// First and second axis of the components of a symmetric tensor: xx, yy, xy; in 3D xx, yy, zz, xy, yz, xz.
template <int D>
constexpr std::array<std::array<int, 2>, D == 2 ? 3 : 6> tensorAxes() {
  if constexpr (D == 2)
    return {{{0, 0}, {1, 1}, {0, 1}}};
  else
    return {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
}

/// Symmetric stresses of degree k on the Alfeld split of the reference simplex (origin and unit vectors), in equilibrium with given
/// tractions and sources: Johnson and Mercier (1978) in 2D, Gopalakrishnan, Guzman and Lee (2024) in 3D. Part a of the split is the hull of
/// side a (opposite to vertex a) and of the centroid; its vertices are those of side a, ascending, then the centroid. The unknowns are the
/// stresses at the nodes of SimplexBasis<D> on each part: ((part) nodes + node) components + component. The data are those of
/// StressElement.
template <int D>
struct AlfeldStresses {
  static constexpr int components = D == 2 ? 3 : 6;

  int unknowns = 0;
  int rank = 0;       ///< rank of the equations: continuity of tractions inside, equilibrium, tractions outside
  Matrix particular;  ///< unknowns x data: stresses for balanced data
  Matrix free;        ///< unknowns x (unknowns - rank): orthonormal basis of the stresses without data

  /// \param degree  1 or 2
  explicit AlfeldStresses(int degree);
};

/// Outward unit normal of a side of the reference simplex.
template <int D>
Eigen::Matrix<double, D, 1> referenceNormal(int side) {
  using Direction = Eigen::Matrix<double, D, 1>;
  if (side == 0) return Direction::Constant(1.0 / std::sqrt(double(D)));
  return -Direction::Unit(side - 1);
}

/// The vertices 0..D but one, ascending.
template <int D>
std::array<int, D> verticesOfSide(int side) {
  std::array<int, D> vertices{};
  for (int i = 0, n = 0; i <= D; ++i)
    if (i != side) vertices[n++] = i;
  return vertices;
}

}  // namespace suture
