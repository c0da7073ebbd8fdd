#include <Eigen/LU>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/ErrorNorms.hpp>
#include <suture/elasticity/SideMap.hpp>

namespace suture {
namespace {

Eigen::Vector3d stressAt(const ElementMap& map, const Span<const int> nodes, const Eigen::Matrix3d& d, const Vector& displacement) {
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double ux = displacement[2 * nodes[a]], uy = displacement[2 * nodes[a] + 1];
    const double gx = map.gradient(int(a))[0], gy = map.gradient(int(a))[1];
    strain += Eigen::Vector3d(gx * ux, gy * uy, gy * ux + gx * uy);
  }
  return d * strain;
}

}  // namespace

BodyErrors bodyErrors(const CellBlock& block, const ExactFields& exact, const std::function<const Material&(int element)>& materialOf,
                      PlaneModel plane, const Vector& displacement) {
  BodyErrors errors;
  const Material* last = nullptr;
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero(), compliance = d;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      d = elasticity(material, plane, 2);
      compliance = d.inverse();
      last = &material;
    }
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Data);
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const Point place = map.place();
      for (std::size_t k = 0; k < exact.displacement.size(); ++k) {
        const double u = exact.displacement[k].at(place);
        double difference = -u;
        for (int a = 0; a < reference.nodes; ++a) difference += reference.valuesAt(q)[a] * displacement[2 * nodes[a] + Eigen::Index(k)];
        errors.displacement.add({map.measure() * difference * difference, map.measure() * u * u});
      }
      if (exact.stress.empty()) continue;
      const Eigen::Vector3d s(exact.stress[0].at(place), exact.stress[1].at(place), exact.stress[2].at(place));
      const Eigen::Vector3d difference = stressAt(map, nodes, d, displacement) - s;
      errors.energy.add({map.measure() * difference.dot(compliance * difference), map.measure() * s.dot(compliance * s)});
    }
  }
  return errors;
}

Matrix sideMass(const std::vector<Point>& nodes) {
  SideMap map(nodes, Rule::Load);
  const int count = map.reference().nodes;
  Matrix mass = Matrix::Zero(count, count);
  for (int q = 0; q < map.reference().points; ++q) {
    map.at(q);
    const Eigen::Map<const Vector> shape(map.reference().valuesAt(q), count);
    mass += map.measure() * shape * shape.transpose();
  }
  return mass;
}

SquaredNorms sideErrors(const std::vector<Point>& nodes, const Vector& values, const Expression& exact) {
  SideMap map(nodes, Rule::Data);
  SquaredNorms errors;
  for (int q = 0; q < map.reference().points; ++q) {
    map.at(q);
    const double p = exact.at(map.place());
    const double difference = Eigen::Map<const Vector>(map.reference().valuesAt(q), values.size()).dot(values) - p;
    errors.add({map.measure() * difference * difference, map.measure() * p * p});
  }
  return errors;
}

}  // namespace suture
