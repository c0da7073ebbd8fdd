#pragma once
#include <Eigen/Geometry>
#include <suture/base/Types.hpp>

#include <array>
#include <vector>

namespace suture {

/// Polynomials of a bound.
struct BoundKind {
  int order = 1;   ///< degree of elements, nodal forces, and tractions on sides at the boundary
  int degree = 1;  ///< degree of stresses; 2 if there are quadrilaterals, whose displacements are interpolated by this degree
};

/// Lagrange nodes of simplices and their sides in the order used by error bounds: vertices in ascending order of their numbers in the mesh,
/// then the middles of edges.
template <int D>
struct SimplexNodes {
  static constexpr int vertices = D + 1;
  static constexpr int edges = D == 2 ? 3 : 6;
  static constexpr int most = vertices + edges;  ///< nodes of degree 2
  /// Ends of each edge; in 2D edge a is the side opposite to vertex a.
  static constexpr std::array<std::array<int, 2>, 6> ends =
      D == 2 ? std::array<std::array<int, 2>, 6>{{{1, 2}, {0, 2}, {0, 1}, {}, {}, {}}}
             : std::array<std::array<int, 2>, 6>{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  static constexpr int nodes(int degree) { return degree == 1 ? vertices : vertices + edges; }
  static constexpr int sideNodes(int degree) { return D == 2 ? degree + 1 : (degree == 1 ? 3 : 6); }
  static constexpr int sourceNodes(int degree) { return degree == 1 ? 1 : D + 1; }

  /// Number of the edge between two vertices a < b.
  static int edge(int a, int b) {
    for (int e = 0; e < edges; ++e)
      if (ends[e][0] == a && ends[e][1] == b) return e;
    return -1;
  }
  /// Node of a simplex at node j of its side opposite to vertex a.
  static int ofSide(int a, int j);
};

/// Conditions on a side at the boundary of the bodies.
template <int D>
struct SideCondition {
  unsigned known = (1u << D) - 1;  ///< bits: components along the axes in which the traction is given
  unsigned kept = 0;               ///< bits: unknown components that are equilibrated with the nodal forces and kept then
  Eigen::Matrix<double, D, D> axes = Eigen::Matrix<double, D, D>::Identity();  ///< rows, orthonormal
  Eigen::Matrix<double, D, 6> traction = Eigen::Matrix<double, D, 6>::Zero();  ///< outward, Cartesian, at the side's nodes [stress]
  /// Elastic support: 1 / stiffness per area along each axis, 0: none [length / stress]; displacement of v at the side's nodes [length].
  Eigen::Matrix<double, D, 1> compliance = Eigen::Matrix<double, D, 1>::Zero();
  Eigen::Matrix<double, D, 6> moved = Eigen::Matrix<double, D, 6>::Zero();

  bool isSupported() const { return (compliance.array() > 0.0).any(); }
};

/// A simplex with what its error depends on.
template <int D>
struct BoundElement {
  using Nodes = SimplexNodes<D>;
  static constexpr int stress = D == 2 ? 3 : 6;
  std::array<GlobalId, D + 1> vertices{};              ///< ascending
  Eigen::Matrix<double, D, D + 1> places;              ///< [length]
  Eigen::Matrix<double, D, (D == 2 ? 6 : 10)> forces;  ///< forces on the nodes, K u - f [force]
  Eigen::Matrix<double, stress, D + 1> stresses;       ///< stresses of v at the vertices: xx, yy, xy; in 3D six [stress]
  Eigen::Matrix<double, D, D + 1> sources;             ///< body force at the source nodes [force / volume]
  Eigen::Matrix<double, stress, stress> compliance;    ///< [1 / stress]
  std::array<int, D + 1> boundary{};                   ///< number of a SideCondition, or -1
};

/// A stress that varies linearly in 3D: columns: value at a centre, then derivatives along x, y and z. Components as in
/// BoundElement::stresses.
using LinearStress = Eigen::Matrix<double, 6, 4>;

/// Symmetric tensor of components in the order of BoundElement::stresses.
template <int D>
Eigen::Matrix<double, D, D> tensorOf(const Eigen::Matrix<double, BoundElement<D>::stress, 1>& s) {
  Eigen::Matrix<double, D, D> t;
  if constexpr (D == 2)
    t << s[0], s[2], s[2], s[1];
  else
    t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

template <int D>
int SimplexNodes<D>::ofSide(int a, int j) {
  const auto vertex = [a](int i) { return i < a ? i : i + 1; };
  if (j < D) return vertex(j);
  if constexpr (D == 2) return vertices + a;
  const int first = j == 4 ? 1 : 0, second = j == 3 ? 1 : 2;
  return vertices + edge(vertex(first), vertex(second));
}

/// Length or area of the side opposite to a vertex. Local.
template <int D>
double sideSize(const BoundElement<D>& element, int opposite) {
  Eigen::Matrix<double, D, D> corners;
  for (int i = 0, j = 0; i <= D; ++i)
    if (i != opposite) corners.col(j++) = element.places.col(i);
  if constexpr (D == 2)
    return (corners.col(1) - corners.col(0)).norm();
  else
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
}

}  // namespace suture
