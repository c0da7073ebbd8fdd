#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

#include <algorithm>

namespace suture {

InitialState::InitialState(const ElasticModel& model, std::function<int(int element)> bodyOf) : bodyOf_(std::move(bodyOf)) {
  if (std::none_of(model.loads.begin(), model.loads.end(), [](const Load& load) { return load.isInitial(); })) return;
  ofBody_.resize(model.bodies.size());
  for (const Load& load : model.loads)
    for (std::size_t body = 0; body < model.bodies.size(); ++body)
      if (load.isInitial() && load.actsOn(model.bodies[body])) ofBody_[body].push_back(&load);
}

InitialState::InitialState(const ElasticModel& model, int body) : InitialState(model, [body](int) { return body; }) {}

InitialState::Values InitialState::at(int element, const Point& place, const HookesLaw& law) const {
  Values values;
  for (const Load* load : ofBody_[bodyOf_(element)]) {
    if (load->kind == Load::Kind::Temperature) {
      values.strain.head<3>().array() += law.expansion * (load->at(place)[0] - load->reference);
      continue;
    }
    const std::array<double, 4> tensor = load->tensorAt(place);
    const Eigen::Map<const Eigen::Vector4d> given(tensor.data());
    if (load->kind == Load::Kind::InitialStrain)
      values.strain += given;
    else if (law.isSheet() && given[2] != 0.0)
      throw InputError(load->path, "an initial stress zz in plane stress, where there is none across the sheet; expected 0");
    else
      values.stress += given;
  }
  return values;
}

Vector initialForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                     const InitialState& initial, Vector* sizes) {
  if (initial.empty()) return {};
  Vector forces = Vector::Zero(Eigen::Index(block.nodes()) * 2);
  if (sizes) *sizes = forces;
  const Material* last = nullptr;
  HookesLaw law;
  for (int e = 0; e < block.elements(); ++e) {
    if (!initial.isIn(e)) continue;
    const Material& material = materialOf(e);
    if (&material != last) law = HookesLaw(material, plane);
    last = &material;
    const ReferenceElement& reference = referenceElement(block.cells[e], stiffnessRule(block));
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * ReferenceElement::maxNodes> own(2 * reference.nodes);
    own.setZero();
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const InitialState::Values here = initial.at(e, map.place(), law);
      const Eigen::Vector4d stress = map.measure() * (law.pointwise * here.strain - here.stress);
      for (int a = 0; a < reference.nodes; ++a) {
        own[2 * a] += map.gradient(a)[0] * stress[0] + map.gradient(a)[1] * stress[3] + map.hoop(a) * stress[2];
        own[2 * a + 1] += map.gradient(a)[1] * stress[1] + map.gradient(a)[0] * stress[3];
      }
    }
    if (law.projected != 0.0) {
      const MixedPressure pressure(block.cells[e], reference, map);
      const auto dilatation =
          pressure.projection(reference, map, [&](const Point& place) { return initial.at(e, place, law).strain.head<3>().sum(); });
      for (int dof = 0; dof < own.size(); ++dof) own[dof] += law.projected * pressure.work(dilatation, dof);
    }
    for (int a = 0; a < reference.nodes; ++a)
      for (int k = 0; k < 2; ++k) {
        forces[2 * nodes[a] + k] += own[2 * a + k];
        if (sizes) (*sizes)[2 * nodes[a] + k] += std::abs(own[2 * a + k]);
      }
  }
  return forces;
}

}  // namespace suture
