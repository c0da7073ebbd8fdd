#pragma once
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// The map from the reference element to an element of the mesh, at the points of a rule. On the stack: the inner loops of assembly
/// allocate nothing. Two-dimensional cells.
class ElementMap {
 public:
  ElementMap(const CellBlock& block, int element, const ReferenceElement& reference);

  /// Moves to a quadrature point. \throws InputError  when the element is folded there (a curved element of a bad mesh), or crosses the
  /// axis of an axisymmetric block; names element and place.
  void at(int point);

  /// Weight of the point times the determinant of the map [area]; in axisymmetric blocks times 2 pi r [volume].
  double measure() const { return measure_; }
  /// Gradient of shape function `a` in the mesh's coordinates [1 / length].
  const double* gradient(int a) const { return gradients_[a]; }
  /// Hoop strain of a unit radial displacement of node `a`: shape function over r [1 / length]; zero in the plane.
  double hoop(int a) const { return block_.axisymmetric ? reference_.valuesAt(point_)[a] / radius_ : 0.0; }
  /// Where the point is in the mesh.
  Point place() const;
  Point node(int a) const { return {x_[a][0], x_[a][1], 0}; }

 private:
  void failFolded(double determinant) const;
  void failAcrossAxis() const;

  const CellBlock& block_;
  int element_;
  const ReferenceElement& reference_;
  double x_[ReferenceElement::maxNodes][2];
  double gradients_[ReferenceElement::maxNodes][2];
  double measure_ = 0.0, radius_ = 0.0;
  int point_ = 0;
};

inline ElementMap::ElementMap(const CellBlock& block, int element, const ReferenceElement& reference)
    : block_(block), element_(element), reference_(reference) {
  const int* nodes = block.connectivity.data() + block.offsets[element];
  for (int a = 0; a < reference.nodes; ++a)
    for (int k = 0; k < 2; ++k) x_[a][k] = block.coordinates[std::size_t(nodes[a]) * 2 + k];
}

inline Point ElementMap::place() const {
  Point p{0, 0, 0};
  const double* values = reference_.valuesAt(point_);
  for (int a = 0; a < reference_.nodes; ++a)
    for (int k = 0; k < 2; ++k) p[k] += values[a] * x_[a][k];
  return p;
}

inline void ElementMap::at(int point) {
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

}  // namespace suture
