#include <suture/base/RigidValues.hpp>
#include <suture/subdomain/RigidModes.hpp>

#include <algorithm>

namespace suture {

Matrix rigidModes(const CellBlock& block) {
  if (!block.axisymmetric) return sectionModes(block);
  Matrix along = Matrix::Zero(Eigen::Index(block.nodes()) * 2, 1);
  for (int node = 0; node < block.nodes(); ++node) along(node * 2 + 1, 0) = 1.0;
  return along;
}

Matrix sectionModes(const CellBlock& block) {
  const int d = block.dimension, n = block.nodes();
  Point centre{0, 0, 0}, low{0, 0, 0}, high{0, 0, 0};
  for (int node = 0; node < n; ++node) {
    const Point p = block.point(node);
    for (int k = 0; k < d; ++k) {
      centre[k] += p[k] / n;
      low[k] = node == 0 ? p[k] : std::min(low[k], p[k]);
      high[k] = node == 0 ? p[k] : std::max(high[k], p[k]);
    }
  }
  double half = 0.0;
  for (int k = 0; k < d; ++k) half = std::max(half, 0.5 * (high[k] - low[k]));
  if (half == 0.0) half = 1.0;

  constexpr Point axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int count = rigidMotions(d);
  Matrix modes(n * d, count);
  for (int node = 0; node < n; ++node) {
    Point arm = minus(block.point(node), centre);
    for (double& x : arm) x /= half;
    for (int i = 0; i < d; ++i) {
      const std::array<double, 6> values = rigidValues(d, arm, axes[i]);
      for (int column = 0; column < count; ++column) modes(node * d + i, column) = values[column];
    }
  }
  return modes;
}

}  // namespace suture
