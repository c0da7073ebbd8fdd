#include <suture/elasticity/EnhancedModes.hpp>

namespace suture {

template <int D>
EnhancedModes<D>::EnhancedModes(const CellBlock& block, int element, const ReferenceElement& rule, const ElementMap<D>& map)
    : axisymmetric_(block.axisymmetric) {
  slopes_.setZero();
  hoops_.setZero();
  setTensors(block.cells[element], map);
  if (axisymmetric_) setMeans(rule, map);
}

template <int D>
void EnhancedModes<D>::setTensors(Cell cell, const ElementMap<D>& map) {
  const double* g = referenceElement(cell, Rule::Centroid).gradientsAt(0);
  double t[D][D];  // t[i]: derivative of the position along reference direction i at the centre
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) {
      t[i][k] = 0.0;
      for (int a = 0; a < nodes; ++a) t[i][k] += g[D * a + i] * map.coordinate(a, k);
    }
  tensors_.setZero();
  if constexpr (D == 2) {
    const double cofactors[2][2] = {{t[1][1], -t[1][0]}, {-t[0][1], t[0][0]}};
    for (int i = 0; i < 2; ++i) {
      const auto [x, y] = cofactors[i];
      tensors_.col(2 * i) << x, 0.0, 0.0, y;
      tensors_.col(2 * i + 1) << 0.0, y, 0.0, x;
    }
    if (axisymmetric_) tensors_(2, 4) = 1.0;
  } else {
    for (int i = 0; i < 3; ++i) {
      const double *v = t[(i + 1) % 3], *w = t[(i + 2) % 3];
      const double x = v[1] * w[2] - v[2] * w[1], y = v[2] * w[0] - v[0] * w[2], z = v[0] * w[1] - v[1] * w[0];
      tensors_.col(3 * i) << x, 0.0, 0.0, y, 0.0, z;
      tensors_.col(3 * i + 1) << 0.0, y, 0.0, x, z, 0.0;
      tensors_.col(3 * i + 2) << 0.0, 0.0, z, 0.0, y, x;
    }
    tensors_.template topRightCorner<3, 4>().setOnes();
  }
}

/// Means over the reference element, weighted with the radius.
template <int D>
void EnhancedModes<D>::setMeans(const ReferenceElement& rule, const ElementMap<D>& map) {
  Functions sums;
  double whole = 0.0;
  for (int q = 0; q < rule.points; ++q) {
    double radius = 0.0, f[Functions::count];
    for (int a = 0; a < nodes; ++a) radius += rule.valuesAt(q)[a] * map.coordinate(a, 0);
    functions_.at(rule.placeAt(q), f);
    for (int i = 0; i < Functions::count; ++i) sums.means[i] += rule.weights[q] * radius * f[i];
    whole += rule.weights[q] * radius;
  }
  for (double& sum : sums.means) sum /= whole;
  functions_ = sums;
}

template <int D>
void EnhancedModes<D>::add(const ElementMap<D>& map) {
  double f[Functions::count];
  functions_.at(map.referencePlace(), f);
  const double inverse = 1.0 / map.determinant(), weight = map.measure() * inverse;
  const Eigen::Map<const Eigen::Matrix<double, D * nodes, 1>> gradients(map.gradient(0));
  for (int i = 0; i < Functions::count; ++i) {
    const double own = weight * f[i];
    for (int j = i; j < Functions::count; ++j) products_[i][j] += own * inverse * f[j];
    slopes_.col(i) += own * gradients;
    if (axisymmetric_)
      for (int a = 0; a < nodes; ++a) hoops_(a, i) += own * map.hoop(a);
  }
}

template <int D>
void EnhancedModes<D>::close(const StressMatrix<D>& law) {
  const Eigen::Matrix<double, stressComponents<D>, count> stresses = law * tensors_;
  Eigen::Matrix<double, count, count> own = Eigen::Matrix<double, count, count>::Identity();
  const int used = D == 2 && !axisymmetric_ ? count - 1 : count;
  for (int m = 0; m < used; ++m)
    for (int n = m; n < used; ++n)  // the lower triangle
      own(n, m) = products_[functionOf(m)][functionOf(n)] * tensors_.col(n).dot(stresses.col(m));
  factor_.compute(own);
  for (int m = 0; m < count; ++m) {
    const StressVector<D> stress = stresses.col(m);
    for (int a = 0; a < nodes; ++a) {
      Eigen::Matrix<double, D, 1> force = forceOfStress<D>(&slopes_(D * a, functionOf(m)), stress);
      if constexpr (D == 2) force[0] += hoops_(a, functionOf(m)) * stress[2];
      coupling_.template block<1, D>(m, D * a) = force.transpose();
    }
  }
}

template <int D>
EnhancedStrain<D> EnhancedModes<D>::strain(const Amplitudes& forces) const {
  const Amplitudes amplitudes = factor_.solve(forces);
  EnhancedStrain<D> strain;
  strain.functions = functions_;
  strain.factors.setZero();
  for (int m = 0; m < count; ++m) strain.factors.col(functionOf(m)) += amplitudes[m] * tensors_.col(m);
  return strain;
}

template class EnhancedModes<2>;
template class EnhancedModes<3>;

}  // namespace suture
