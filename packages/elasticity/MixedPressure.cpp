#include <suture/elasticity/MixedPressure.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace suture {

MixedPressure::MixedPressure(Cell cell, const ReferenceElement& reference, ElementMap& map)
    : count_(cell == Cell::Quadrilateral9 ? most : 1),
      root_(decltype(root_)::Zero(count_, count_)),
      rows_(decltype(rows_)::Zero(count_, 2 * reference.nodes)) {
  if (count_ > 1) {
    const Point first = map.node(0), opposite = map.node(2);
    for (int k = 0; k < 2; ++k) centre_[k] = (first[k] + opposite[k]) / 2;
    size_ = std::hypot(opposite[0] - first[0], opposite[1] - first[1]) / 2;
  }
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Projection weighted = map.measure() * basisAt(map.place());
    root_ += weighted * basisAt(map.place()).transpose();
    for (int a = 0; a < reference.nodes; ++a) {
      rows_.col(2 * a) += weighted * (map.gradient(a)[0] + map.hoop(a));
      rows_.col(2 * a + 1) += weighted * map.gradient(a)[1];
    }
  }
  root_ = root_.llt().matrixL().toDenseMatrix();
  root_.triangularView<Eigen::Lower>().solveInPlace(rows_);
}

MixedPressure::Projection MixedPressure::basisAt(const Point& place) const {
  Projection values = Projection::Ones(count_);
  if (count_ > 1)
    for (int k = 0; k < 2; ++k) values[1 + k] = (place[k] - centre_[k]) / size_;
  return values;
}

}  // namespace suture
