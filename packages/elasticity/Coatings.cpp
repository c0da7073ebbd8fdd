#include <suture/elasticity/Coatings.hpp>
#include <suture/elasticity/SideMap.hpp>

#include <algorithm>
#include <limits>

namespace suture {

namespace {

/// Integral of N_a N_b with the coating's stiffness: of one end of the springs.
Matrix endStiffness(const CellBlock& block, const Coating& coating) {
  std::vector<Point> points;
  for (const int node : block.innerNodes(coating)) points.push_back(block.point(node));
  const int dimension = block.dimension;
  SideMap map(points, dimension, Rule::Load, block.axisymmetric);
  const ReferenceElement& reference = map.reference();
  Matrix all = Matrix::Zero(dimension * reference.nodes, dimension * reference.nodes);
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    if (!(map.measure() > 0.0)) continue;  // on an axis of revolution
    const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3d>(map.normal().data()) / map.measure();
    const Eigen::Matrix3d along = normal * normal.transpose(),
                          here = map.measure() * (coating.normal * along + coating.tangential * (Eigen::Matrix3d::Identity() - along));
    for (int a = 0; a < reference.nodes; ++a)
      for (int b = 0; b < reference.nodes; ++b)
        all.block(dimension * a, dimension * b, dimension, dimension) +=
            reference.valuesAt(q)[a] * reference.valuesAt(q)[b] * here.topLeftCorner(dimension, dimension);
  }
  return all;
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
