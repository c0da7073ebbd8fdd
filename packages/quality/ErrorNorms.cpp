#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/elasticity/SideMap.hpp>
#include <suture/quality/ErrorNorms.hpp>

namespace suture {

namespace {

/// Stress across the plane, from the others: its strain is opposite to the initial one.
double acrossPlane(const Eigen::Vector4d& s, const InitialState::Values& initial, const HookesLaw& law) {
  return law.across(s - initial.stress) + initial.stress[2] - initial.strain[2] / law.compliance(2, 2);
}

}  // namespace

BodyErrors bodyErrors(const CellBlock& block, const ExactFields& exact, const std::function<const Material&(int element)>& materialOf,
                      PlaneModel plane, const Vector& displacement, const InitialState& initial) {
  BodyErrors errors;
  if (block.axisymmetric && exact.stress.size() == 3)
    throw InputError("Exact Solution", "'Stress zz' is missing: in an axisymmetric scene the hoop stress does not follow from the others");
  const Material* last = nullptr;
  HookesLaw law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) law = HookesLaw(material, plane);
    last = &material;
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Data);
    const Span<const int> nodes = block.nodesOf(e);
    ElementStress element(block, e, reference, law, displacement, initial);
    const ElementMap& map = element.map();
    for (int q = 0; q < reference.points; ++q) {
      element.at(q);
      const Point place = map.place();
      for (std::size_t k = 0; k < exact.displacement.size(); ++k) {
        const double u = exact.displacement[k].at(place);
        double difference = -u;
        for (int a = 0; a < reference.nodes; ++a) difference += reference.valuesAt(q)[a] * displacement[2 * nodes[a] + Eigen::Index(k)];
        errors.displacement.add({map.measure() * difference * difference, map.measure() * u * u});
      }
      if (exact.stress.empty()) continue;
      const auto given = [&](int k) { return exact.stress[std::size_t(k)].at(place); };
      Eigen::Vector4d s(given(0), given(1), 0.0, given(2));
      s[2] = exact.stress.size() > 3 ? given(3) : plane == PlaneModel::Strain ? acrossPlane(s, element.initial(), law) : 0.0;
      const Eigen::Vector4d difference = element.stress() - s;
      errors.energy.add({map.measure() * law.complementary(difference), map.measure() * law.complementary(s)});
    }
  }
  return errors;
}

Matrix sideMass(const std::vector<Point>& nodes, bool axisymmetric) {
  SideMap map(nodes, Rule::Load, axisymmetric);
  const int count = map.reference().nodes;
  Matrix mass = Matrix::Zero(count, count);
  for (int q = 0; q < map.reference().points; ++q) {
    map.at(q);
    const Eigen::Map<const Vector> shape(map.reference().valuesAt(q), count);
    mass += map.measure() * shape * shape.transpose();
  }
  return mass;
}

SquaredNorms sideErrors(const std::vector<Point>& nodes, const Vector& values, const Expression& exact, bool axisymmetric) {
  SideMap map(nodes, Rule::Data, axisymmetric);
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
