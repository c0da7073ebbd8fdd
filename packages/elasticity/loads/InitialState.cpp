#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/EnhancedModes.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

#include <algorithm>
#include <optional>

namespace suture {

InitialState::InitialState(const ElasticModel& model, std::function<int(int element)> bodyOf) : bodyOf_(std::move(bodyOf)) {
  if (std::none_of(model.loads.begin(), model.loads.end(), [](const Load& load) { return load.isInitial(); })) return;
  ofBody_.resize(model.bodies.size());
  for (const Load& load : model.loads)
    for (std::size_t body = 0; body < model.bodies.size(); ++body)
      if (load.isInitial() && load.actsOn(model.bodies[body])) ofBody_[body].push_back(&load);
}

InitialState::InitialState(const ElasticModel& model, int body) : InitialState(model, [body](int) { return body; }) {}

template <int D>
InitialState::Values<D> InitialState::at(int element, const Point& place, const HookesLaw<D>& law) const {
  Values<D> values;
  for (const Load* load : ofBody_[bodyOf_(element)]) {
    if (load->kind == Load::Kind::Temperature) {
      values.strain.template head<3>().array() += load->factor * law.expansion * (load->at(place)[0] - load->reference);
      continue;
    }
    const std::array<double, 6> tensor = load->tensorAt(place);
    const StressVector<D> given = load->factor * Eigen::Map<const StressVector<D>>(tensor.data());
    if (load->kind == Load::Kind::InitialStrain)
      values.strain += given;
    else if (law.isSheet() && given[2] != 0.0)
      throw InputError(load->path, "an initial stress zz, which does not exist in plane stress; expected 0");
    else
      values.stress += given;
  }
  return values;
}

template InitialState::Values<2> InitialState::at(int, const Point&, const HookesLaw<2>&) const;
template InitialState::Values<3> InitialState::at(int, const Point&, const HookesLaw<3>&) const;

namespace {

template <int D>
Vector forcesOf(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                const InitialState& initial, Vector* sizes) {
  Vector forces = Vector::Zero(Eigen::Index(block.nodes()) * D);
  if (sizes) *sizes = forces;
  const Material* last = nullptr;
  HookesLaw<D> ofMaterial;
  for (int e = 0; e < block.elements(); ++e) {
    if (!initial.isIn(e)) continue;
    const Material& material = materialOf(e);
    if (&material != last) ofMaterial = HookesLaw<D>(material, plane);
    last = &material;
    const HookesLaw<D> law = ofMaterial.of(block.cells[e]);
    const ReferenceElement& reference = stiffnessElement(block, e);
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap<D> map(block, e, reference);
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, D * mostNodes<D>> own(D * reference.nodes);
    own.setZero();
    std::optional<EnhancedModes<D>> modes;
    typename EnhancedModes<D>::Amplitudes onModes = EnhancedModes<D>::Amplitudes::Zero();
    if (law.enhanced) modes.emplace(block, e, reference, map);
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const InitialState::Values<D> here = initial.at(e, map.place(), law);
      const StressVector<D> whole = law.pointwise * here.strain - here.stress, stress = map.measure() * whole;
      if (modes) {
        modes->add(map);
        modes->addForces(map, whole, onModes);
      }
      for (int a = 0; a < reference.nodes; ++a) {
        Eigen::Matrix<double, D, 1> force = forceOfStress<D>(map.gradient(a), stress);
        force[0] += map.hoop(a) * stress[2];
        own.template segment<D>(D * a) += force;
      }
    }
    if (modes) {
      modes->close(law.pointwise);
      own += modes->condensed(onModes);
    }
    if (law.projected != 0.0) {
      const MixedPressure<D> pressure(block.cells[e], reference, map);
      const auto dilatation = pressure.projection(
          reference, map, [&](const Point& place) { return initial.at(e, place, law).strain.template head<3>().sum(); });
      for (int dof = 0; dof < own.size(); ++dof) own[dof] += law.projected * pressure.work(dilatation, dof);
    }
    for (int a = 0; a < reference.nodes; ++a)
      for (int k = 0; k < D; ++k) {
        forces[D * nodes[a] + k] += own[D * a + k];
        if (sizes) (*sizes)[D * nodes[a] + k] += std::abs(own[D * a + k]);
      }
  }
  return forces;
}

}  // namespace

Vector initialForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                     const InitialState& initial, Vector* sizes) {
  if (initial.empty()) return {};
  return block.dimension == 2 ? forcesOf<2>(block, materialOf, plane, initial, sizes)
                              : forcesOf<3>(block, materialOf, plane, initial, sizes);
}

}  // namespace suture
