#include <suture/elasticity/SideMap.hpp>
#include <suture/elasticity/SideSprings.hpp>

namespace suture {

Matrix sideSprings(const std::vector<Point>& points, const CellBlock& block, double normal, double tangential) {
  const int dimension = block.dimension;
  SideMap map(points, dimension, Rule::Load, block.axisymmetric);
  const ReferenceElement& reference = map.reference();
  Matrix all = Matrix::Zero(dimension * reference.nodes, dimension * reference.nodes);
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    if (!(map.measure() > 0.0)) continue;  // on the axis of revolution
    const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3d>(map.normal().data()) / map.measure();
    const Eigen::Matrix3d across = n * n.transpose(),
                          here = map.measure() * (normal * across + tangential * (Eigen::Matrix3d::Identity() - across));
    for (int a = 0; a < reference.nodes; ++a)
      for (int b = 0; b < reference.nodes; ++b)
        all.block(dimension * a, dimension * b, dimension, dimension) +=
            reference.valuesAt(q)[a] * reference.valuesAt(q)[b] * here.topLeftCorner(dimension, dimension);
  }
  return all;
}

}  // namespace suture
