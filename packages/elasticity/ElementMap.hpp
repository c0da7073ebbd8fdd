#pragma once
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// Map from the reference element to an element of the mesh, at the points of a quadrature rule. Lives on the stack: the inner loops of
/// assembly allocate nothing. \tparam D  dimension of the cells, 2 or 3
template <int D>
class ElementMap {
 public:
  ElementMap(const CellBlock& block, int element, const ReferenceElement& reference);

  /// Moves to a quadrature point. \throws InputError  if the element is folded there (a curved element of a bad mesh), or crosses the axis
  /// of an axisymmetric block; names element and position.
  void at(int point);

  /// Weight of the point times the determinant of the map [area or volume]; in axisymmetric blocks times 2 pi r [volume].
  double measure() const { return measure_; }
  /// Determinant of the map at the point.
  double determinant() const { return determinant_; }
  /// Reference coordinates of the point.
  const double* referencePlace() const { return reference_.placeAt(point_); }
  /// Gradient of shape function `a` in the mesh's coordinates [1 / length].
  const double* gradient(int a) const { return gradients_[a]; }
  /// Hoop strain of a unit radial displacement of node `a`: shape function over r [1 / length]; zero if not axisymmetric.
  double hoop(int a) const {
    if constexpr (D == 2) return block_.axisymmetric ? reference_.valuesAt(point_)[a] / radius_ : 0.0;
    return 0.0;
  }
  /// Position of the point in the mesh.
  Point place() const;
  Point node(int a) const {
    Point p{0, 0, 0};
    for (int k = 0; k < D; ++k) p[k] = x_[a][k];
    return p;
  }
  double coordinate(int a, int k) const { return x_[a][k]; }

 private:
  void failFolded(double determinant) const;
  void failAcrossAxis() const;

  const CellBlock& block_;
  int element_;
  const ReferenceElement& reference_;
  double x_[mostNodes<D>][D];
  double gradients_[mostNodes<D>][D];
  double measure_ = 0.0, determinant_ = 0.0, radius_ = 0.0;
  int point_ = 0;
};

template <int D>
inline ElementMap<D>::ElementMap(const CellBlock& block, int element, const ReferenceElement& reference)
    : block_(block), element_(element), reference_(reference) {
  const int* nodes = block.connectivity.data() + block.offsets[element];
  for (int a = 0; a < reference.nodes; ++a)
    for (int k = 0; k < D; ++k) x_[a][k] = block.coordinates[std::size_t(nodes[a]) * D + k];
}

template <int D>
inline Point ElementMap<D>::place() const {
  Point p{0, 0, 0};
  const double* values = reference_.valuesAt(point_);
  for (int a = 0; a < reference_.nodes; ++a)
    for (int k = 0; k < D; ++k) p[k] += values[a] * x_[a][k];
  return p;
}

template <>
inline void ElementMap<2>::at(int point) {
  point_ = point;
  const double* g = reference_.gradientsAt(point);
  double xu = 0, xv = 0, yu = 0, yv = 0;  // d(x, y) / d(reference coordinates u, v)
  for (int a = 0; a < reference_.nodes; ++a) {
    xu += x_[a][0] * g[2 * a];
    xv += x_[a][0] * g[2 * a + 1];
    yu += x_[a][1] * g[2 * a];
    yv += x_[a][1] * g[2 * a + 1];
  }
  const double determinant = xu * yv - xv * yu;
  if (!(determinant > 0.0)) failFolded(determinant);
  determinant_ = determinant;
  const double inverse = 1.0 / determinant;
  for (int a = 0; a < reference_.nodes; ++a) {
    gradients_[a][0] = (yv * g[2 * a] - yu * g[2 * a + 1]) * inverse;
    gradients_[a][1] = (xu * g[2 * a + 1] - xv * g[2 * a]) * inverse;
  }
  measure_ = determinant * reference_.weights[point];
  if (block_.axisymmetric) {
    radius_ = place()[0];
    if (!(radius_ > 0.0)) failAcrossAxis();
    measure_ *= circumference(radius_);
  }
}

template <>
inline void ElementMap<3>::at(int point) {
  point_ = point;
  const double* g = reference_.gradientsAt(point);
  double xu = 0, xv = 0, xw = 0, yu = 0, yv = 0, yw = 0, zu = 0, zv = 0, zw = 0;  // d(x, y, z) / d(reference coordinates u, v, w)
  for (int a = 0; a < reference_.nodes; ++a) {
    const double u = g[3 * a], v = g[3 * a + 1], w = g[3 * a + 2];
    xu += x_[a][0] * u, xv += x_[a][0] * v, xw += x_[a][0] * w;
    yu += x_[a][1] * u, yv += x_[a][1] * v, yw += x_[a][1] * w;
    zu += x_[a][2] * u, zv += x_[a][2] * v, zw += x_[a][2] * w;
  }
  double ux = yv * zw - yw * zv, vx = yw * zu - yu * zw, wx = yu * zv - yv * zu;  // cofactors: determinant x du/dx, ...
  const double determinant = xu * ux + xv * vx + xw * wx;
  if (!(determinant > 0.0)) failFolded(determinant);
  determinant_ = determinant;
  const double inverse = 1.0 / determinant;
  ux *= inverse, vx *= inverse, wx *= inverse;
  const double uy = (zv * xw - zw * xv) * inverse, vy = (zw * xu - zu * xw) * inverse, wy = (zu * xv - zv * xu) * inverse,
               uz = (xv * yw - xw * yv) * inverse, vz = (xw * yu - xu * yw) * inverse, wz = (xu * yv - xv * yu) * inverse;
  for (int a = 0; a < reference_.nodes; ++a) {
    const double u = g[3 * a], v = g[3 * a + 1], w = g[3 * a + 2];
    gradients_[a][0] = ux * u + vx * v + wx * w;
    gradients_[a][1] = uy * u + vy * v + wy * w;
    gradients_[a][2] = uz * u + vz * v + wz * w;
  }
  measure_ = determinant * reference_.weights[point];
}

}  // namespace suture
