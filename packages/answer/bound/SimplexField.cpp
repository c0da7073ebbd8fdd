#include <Eigen/LU>
#include <suture/answer/bound/SimplexField.hpp>

#include <cmath>

namespace suture {

namespace {

/// Strain due to a displacement gradient du_i / dx_j.
template <int D>
Eigen::Matrix<double, BoundElement<D>::stress, 1> strainOfGradient(const Eigen::Matrix<double, D, D>& slope) {
  Eigen::Matrix<double, BoundElement<D>::stress, 1> e;
  if constexpr (D == 2)
    e << slope(0, 0), slope(1, 1), slope(0, 1) + slope(1, 0);
  else
    e << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1), slope(0, 2) + slope(2, 0);
  return e;
}

}  // namespace

template <int D>
SimplexField<D>::SimplexField(const Eigen::Matrix<double, D, D + 1>& vertices) {
  const Eigen::Matrix<double, D, D> map = vertices.template rightCols<D>().colwise() - vertices.col(0);
  volume_ = std::abs(map.determinant()) / (D == 2 ? 2 : 6);
  gradients_.template rightCols<D>() = map.inverse().transpose();
  gradients_.col(0) = -gradients_.template rightCols<D>().rowwise().sum();
}

template <int D>
typename SimplexField<D>::AtVertices SimplexField<D>::strains(const Nodal& displacements, int degree) const {
  using Slope = Eigen::Matrix<double, D, D>;
  using Nodes = SimplexNodes<D>;
  AtVertices all;
  if (degree == 1) {
    const Slope slope = displacements.template leftCols<D + 1>() * gradients_.transpose();
    all.colwise() = strainOfGradient<D>(slope);
    return all;
  }
  // At vertex q the function of vertex i has the slope 3 or -1 times the gradient of coordinate i.
  const Slope common = -displacements.template leftCols<D + 1>() * gradients_.transpose();
  for (int q = 0; q <= D; ++q) {
    Slope slope = common + 4.0 * displacements.col(q) * gradients_.col(q).transpose();
    for (int edge = 0; edge < Nodes::edges; ++edge)
      for (int end = 0; end < 2; ++end)
        if (Nodes::ends[edge][end] == q)
          slope += 4.0 * displacements.col(D + 1 + edge) * gradients_.col(Nodes::ends[edge][1 - end]).transpose();
    all.col(q) = strainOfGradient<D>(slope);
  }
  return all;
}

template <int D>
typename SimplexField<D>::Nodal SimplexField<D>::forces(const AtVertices& stresses, int degree) const {
  using Nodes = SimplexNodes<D>;
  using Tensor = Eigen::Matrix<double, D, D>;
  Nodal all = Nodal::Zero();
  const Eigen::Matrix<double, stress, 1> sum = stresses.rowwise().sum();
  if (degree == 1) {
    all.template leftCols<D + 1>() = tensorOf<D>(volume_ / (D + 1) * sum) * gradients_;
    return all;
  }
  // Means of l_q (4 l_a - 1) and of l_q 4 l_a; the mean of l_q l_a is (1 + [q = a]) / ((D + 1) (D + 2)).
  const double product = 4 * volume_ / ((D + 1) * (D + 2));
  Tensor with[D + 1];  // integral of 4 l_a s
  for (int a = 0; a <= D; ++a) {
    with[a] = tensorOf<D>(product * (sum + stresses.col(a)));
    all.col(a) = (with[a] - tensorOf<D>(volume_ / (D + 1) * sum)) * gradients_.col(a);
  }
  for (int edge = 0; edge < Nodes::edges; ++edge) {
    const auto [a, b] = Nodes::ends[edge];
    all.col(D + 1 + edge) = with[a] * gradients_.col(b) + with[b] * gradients_.col(a);
  }
  return all;
}

template <int D>
typename SimplexField<D>::Nodal SimplexField<D>::forcesOfSources(const Eigen::Matrix<double, D, D + 1>& sources, int degree) const {
  using Nodes = SimplexNodes<D>;
  Nodal all = Nodal::Zero();
  const Eigen::Matrix<double, D, 1> sum = sources.rowwise().sum();
  if (degree == 1) {
    all.template leftCols<D + 1>() = volume_ / ((D + 1) * (D + 2)) * (sources.colwise() + sum);
    return all;
  }
  // Means of l_q l_i (2 l_i - 1) and of l_q 4 l_i l_j on a simplex.
  constexpr double same = D == 2 ? 1.0 / 30 : 0.0, other = -1.0 / 60, atEdge = D == 2 ? 1.0 / 15 : 1.0 / 30;
  all.template leftCols<D + 1>() = (volume_ * (same - other) * sources).colwise() + volume_ * other * sum;
  for (int edge = 0; edge < Nodes::edges; ++edge)
    all.col(D + 1 + edge) = volume_ * atEdge * (sum + sources.col(Nodes::ends[edge][0]) + sources.col(Nodes::ends[edge][1]));
  return all;
}

template <int D>
double SimplexField<D>::energy(const AtVertices& stresses, const Stiffness& compliance) const {
  const Eigen::Matrix<double, stress, 1> sum = stresses.rowwise().sum();
  double squares = sum.dot(compliance * sum);
  for (int q = 0; q <= D; ++q) squares += stresses.col(q).dot(compliance * stresses.col(q));
  return volume_ / ((D + 1) * (D + 2)) * squares;
}

template class SimplexField<2>;
template class SimplexField<3>;

}  // namespace suture
