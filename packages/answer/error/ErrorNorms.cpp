#include <suture/answer/error/ErrorNorms.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/elasticity/SideMap.hpp>

namespace suture {

namespace {

/// Out-of-plane stress from the in-plane stresses: its strain is opposite to the initial strain.
double acrossPlane(const StressVector<2>& s, const InitialState::Values<2>& initial, const HookesLaw<2>& law) {
  return law.across(s - initial.stress) + initial.stress[2] - initial.strain[2] / law.compliance(2, 2);
}

template <int D>
StressVector<D> exactStress(const ExactFields& exact, const Point& place, PlaneModel plane, const ElementStress<D>& element,
                            const HookesLaw<D>& law) {
  const auto given = [&](int k) { return exact.stress[std::size_t(k)].at(place); };
  StressVector<D> s;
  if constexpr (D == 2) {
    s << given(0), given(1), 0.0, given(2);
    s[2] = exact.stress.size() > 3 ? given(3) : plane == PlaneModel::Strain ? acrossPlane(s, element.initial(), law) : 0.0;
  } else {
    for (int k = 0; k < stressComponents<D>; ++k) s[k] = given(k);
  }
  return s;
}

template <int D>
BodyErrors errorsIn(const CellBlock& block, const ExactFields& exact, const std::function<const Material&(int element)>& materialOf,
                    PlaneModel plane, const Vector& displacement, const InitialState& initial) {
  BodyErrors errors;
  const Material* last = nullptr;
  HookesLaw<D> law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) law = HookesLaw<D>(material, plane);
    last = &material;
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Data);
    const Span<const int> nodes = block.nodesOf(e);
    ElementStress<D> element(block, e, reference, law, displacement, initial);
    const ElementMap<D>& map = element.map();
    for (int q = 0; q < reference.points; ++q) {
      element.at(q);
      const Point place = map.place();
      for (std::size_t k = 0; k < exact.displacement.size(); ++k) {
        const double u = exact.displacement[k].at(place);
        double difference = -u;
        for (int a = 0; a < reference.nodes; ++a) difference += reference.valuesAt(q)[a] * displacement[D * nodes[a] + Eigen::Index(k)];
        errors.displacement.add({map.measure() * difference * difference, map.measure() * u * u});
      }
      if (exact.stress.empty()) continue;
      const StressVector<D> s = exactStress<D>(exact, place, plane, element, law), difference = element.stress() - s;
      errors.energy.add({map.measure() * law.complementary(difference), map.measure() * law.complementary(s)});
    }
  }
  return errors;
}

}  // namespace

BodyErrors bodyErrors(const CellBlock& block, const ExactFields& exact, const std::function<const Material&(int element)>& materialOf,
                      PlaneModel plane, const Vector& displacement, const InitialState& initial) {
  if (block.axisymmetric && exact.stress.size() == 3)
    throw InputError("Exact Solution",
                     "'Stress zz' is missing: in an axisymmetric scene the hoop stress cannot be derived from the others");
  return block.dimension == 2 ? errorsIn<2>(block, exact, materialOf, plane, displacement, initial)
                              : errorsIn<3>(block, exact, materialOf, plane, displacement, initial);
}

Matrix sideMass(const std::vector<Point>& nodes, int dimension, bool axisymmetric) {
  SideMap map(nodes, dimension, Rule::Load, axisymmetric);
  const int count = map.reference().nodes;
  Matrix mass = Matrix::Zero(count, count);
  for (int q = 0; q < map.reference().points; ++q) {
    map.at(q);
    const Eigen::Map<const Vector> shape(map.reference().valuesAt(q), count);
    mass += map.measure() * shape * shape.transpose();
  }
  return mass;
}

SquaredNorms sideErrors(const std::vector<Point>& nodes, int dimension, const Vector& values, const Expression& exact, bool axisymmetric) {
  SideMap map(nodes, dimension, Rule::Data, axisymmetric);
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
