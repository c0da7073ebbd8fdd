#include <suture/elasticity/MixedPressure.hpp>

#include <Eigen/Cholesky>
#include <suture/base/Point.hpp>

namespace suture {

template <int D>
MixedPressure<D>::MixedPressure(Cell cell, const ReferenceElement& reference, ElementMap<D>& map)
    : count_(cell == Cell::Quadrilateral9 || cell == Cell::Hexahedron27 ? most : 1),
      root_(decltype(root_)::Zero(count_, count_)),
      rows_(decltype(rows_)::Zero(count_, D * reference.nodes)) {
  if (count_ > 1) {
    const Point first = map.node(0), opposite = map.node(D == 2 ? 2 : 6);
    for (int k = 0; k < D; ++k) centre_[k] = (first[k] + opposite[k]) / 2;
    size_ = norm(minus(opposite, first)) / 2;
  }
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Projection weighted = map.measure() * basisAt(map.place());
    root_ += weighted * basisAt(map.place()).transpose();
    for (int a = 0; a < reference.nodes; ++a) {
      rows_.col(D * a) += weighted * (map.gradient(a)[0] + map.hoop(a));
      for (int k = 1; k < D; ++k) rows_.col(D * a + k) += weighted * map.gradient(a)[k];
    }
  }
  root_ = root_.llt().matrixL().toDenseMatrix();
  root_.template triangularView<Eigen::Lower>().solveInPlace(rows_);
}

template <int D>
typename MixedPressure<D>::Projection MixedPressure<D>::basisAt(const Point& place) const {
  Projection values = Projection::Ones(count_);
  if (count_ > 1)
    for (int k = 0; k < D; ++k) values[1 + k] = (place[k] - centre_[k]) / size_;
  return values;
}

template class MixedPressure<2>;
template class MixedPressure<3>;

}  // namespace suture
