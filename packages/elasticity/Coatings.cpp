#include <suture/elasticity/Coatings.hpp>
#include <suture/elasticity/SideSprings.hpp>

#include <algorithm>
#include <limits>

namespace suture {

namespace {

/// Stiffness of one end of the springs.
Matrix endStiffness(const CellBlock& block, const Coating& coating) {
  std::vector<Point> points;
  for (const int node : block.innerNodes(coating)) points.push_back(block.point(node));
  return sideSprings(points, block, coating.normal, coating.tangential);
}

}  // namespace

Matrix coatingStiffness(const CellBlock& block, const Coating& coating) {
  const Matrix end = endStiffness(block, coating);
  Matrix all(2 * end.rows(), 2 * end.cols());
  all << end, -end, -end, end;
  return all;
}

void coatingStiffnesses(const CellBlock& block, const std::function<void(int element, ConstLocalView stiffness)>& take) {
  int number = block.elements();
  for (const Coating& coating : block.coatings) take(number++, coatingStiffness(block, coating));
}

void addCoatingForces(const CellBlock& block, const Vector& displacement, ElementForces& forces) {
  const int d = block.dimension;
  for (const Coating& coating : block.coatings) {
    const std::vector<int> inner = block.innerNodes(coating);
    const Span<const int> outer = block.outerNodes(coating);
    const Matrix stiffness = endStiffness(block, coating);
    const auto count = static_cast<Eigen::Index>(inner.size());
    Vector jump(d * count);
    double largest = 0.0;
    for (Eigen::Index a = 0; a < count; ++a) {
      const auto from = displacement.segment(Eigen::Index(inner[a]) * d, d), to = displacement.segment(Eigen::Index(outer[a]) * d, d);
      jump.segment(a * d, d) = to - from;
      largest = std::max({largest, from.lpNorm<Eigen::Infinity>(), to.lpNorm<Eigen::Infinity>()});
    }
    const Vector force = stiffness * jump;
    for (Eigen::Index a = 0; a < count; ++a) {
      const double rounding = std::numeric_limits<double>::epsilon() * largest * stiffness.middleRows(a * d, d).cwiseAbs().sum();
      const double own = stiffness.diagonal().segment(a * d, d).sum() / d;
      for (const auto& [node, sign] : {std::make_pair(inner[a], -1.0), std::make_pair(outer[a], 1.0)}) {
        forces.internal.segment(Eigen::Index(node) * d, d) += sign * force.segment(a * d, d);
        forces.rounding[node] += rounding;
        forces.stiffness[node] += own;
      }
    }
  }
}

}  // namespace suture
