#pragma once
#include <Eigen/Core>

namespace suture {

/// Jacobian of the map from the reference cell: columns are derivatives along its directions. Local.
/// \param jets    shape functions with gradients at a place of the reference cell
/// \param places  nodes of the cell, dimension x nodes [length]
template <typename Jets, typename Nodal>
Eigen::Matrix<double, Nodal::RowsAtCompileTime, Nodal::RowsAtCompileTime> jacobianOf(const Jets& jets, const Nodal& places) {
  constexpr int d = Nodal::RowsAtCompileTime;
  Eigen::Matrix<double, d, d> map = Eigen::Matrix<double, d, d>::Zero();
  for (int i = 0; i < int(places.cols()); ++i)
    for (int k = 0; k < d; ++k) map.col(k) += jets[i].gradient[k] * places.col(i);
  return map;
}

/// Value of a nodal field at a place of the reference cell. Local. \param jets  see jacobianOf() \param values  dimension x nodes
template <typename Jets, typename Nodal>
Eigen::Matrix<double, Nodal::RowsAtCompileTime, 1> valueOf(const Jets& jets, const Nodal& values) {
  Eigen::Matrix<double, Nodal::RowsAtCompileTime, 1> sum = Eigen::Matrix<double, Nodal::RowsAtCompileTime, 1>::Zero();
  for (int i = 0; i < int(values.cols()); ++i) sum += jets[i].value * values.col(i);
  return sum;
}

}  // namespace suture
