#include <suture/elasticity/ElementStress.hpp>

#include <algorithm>

namespace suture {

template <int D>
ElementStress<D>::ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw<D>& law,
                                const Vector& displacement, const InitialState& initial)
    : element_(element),
      initial_(initial.isIn(element) ? &initial : nullptr),
      law_(law),
      map_(block, element, reference),
      u_(D * reference.nodes),
      axisymmetric_(block.axisymmetric) {
  const bool isEnhanced = law.enhanced && mayBeEnhanced(block.cells[element]);
  if (isEnhanced && law.projected != 0.0) own_.emplace(law.of(block.cells[element]));
  const Span<const int> nodes = block.nodesOf(element);
  for (int a = 0; a < reference.nodes; ++a)
    for (int k = 0; k < D; ++k) u_[D * a + k] = displacement[D * nodes[a] + k];
  if (cellLaw().projected != 0.0) findPressure(block);
  if (isEnhanced && !vanishAtCentre(reference)) findEnhancedStrain(block);
}

template <int D>
bool ElementStress<D>::vanishAtCentre(const ReferenceElement& reference) const {
  const auto& places = reference.places;
  return !axisymmetric_ && std::all_of(places.begin(), places.end(), [](double x) { return x == 0.0; });
}

template <int D>
void ElementStress<D>::findPressure(const CellBlock& block) {
  const ReferenceElement& whole = stiffnessElement(block, element_);
  ElementMap<D> through(block, element_, whole);
  pressure_.emplace(block.cells[element_], whole, through);
  if (initial_)
    initialDilatation_ = pressure_->projection(
        whole, through, [&](const Point& place) { return initial_->at(element_, place, cellLaw()).strain.template head<3>().sum(); });
}

template <int D>
void ElementStress<D>::findEnhancedStrain(const CellBlock& block) {
  using Modes = EnhancedModes<D>;
  const ReferenceElement& whole = stiffnessElement(block, element_);
  ElementMap<D> through(block, element_, whole);
  Modes modes(block, element_, whole, through);
  typename Modes::Amplitudes forces = Modes::Amplitudes::Zero();
  for (int q = 0; q < whole.points; ++q) {
    through.at(q);
    modes.add(through);
    if (!initial_) continue;
    const InitialState::Values<D> here = initial_->at(element_, through.place(), cellLaw());
    modes.addForces(through, cellLaw().pointwise * here.strain - here.stress, forces);
  }
  modes.close(cellLaw().pointwise);
  enhanced_ = modes.strainOf(u_);
  if (initial_) enhancedInitial_ = modes.strain(forces);
}

template <int D>
StressVector<D> ElementStress<D>::stress() const {
  StressVector<D> stress = ofDisplacement();
  if (!initial_) return stress;
  const InitialState::Values<D> here = initial();
  stress += here.stress - cellLaw().pointwise * here.strain;
  if (enhancedInitial_) stress += cellLaw().pointwise * enhancedInitial_->at(map_);
  if (pressure_) stress.template head<3>().array() -= cellLaw().projected * pressure_->at(initialDilatation_, map_.place());
  return stress;
}

template <int D>
StressVector<D> ElementStress<D>::ofDisplacement() const {
  const int nodes = static_cast<int>(u_.size()) / D;
  StressVector<D> strain;
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, xz = 0.0;  // scalars, so that they stay in registers
  for (int a = 0; a < nodes; ++a) {
    const double ux = u_[D * a], uy = u_[D * a + 1], gx = map_.gradient(a)[0], gy = map_.gradient(a)[1];
    xx += gx * ux;
    yy += gy * uy;
    xy += gy * ux + gx * uy;
    if constexpr (D == 3) {
      const double uz = u_[D * a + 2], gz = map_.gradient(a)[2];
      zz += gz * uz;
      yz += gz * uy + gy * uz;
      xz += gz * ux + gx * uz;
    }
  }
  if (axisymmetric_)
    for (int a = 0; a < nodes; ++a) zz += map_.hoop(a) * u_[D * a];
  if constexpr (D == 2)
    strain << xx, yy, zz, xy;
  else
    strain << xx, yy, zz, xy, yz, xz;
  if (enhanced_) strain += enhanced_->at(map_);
  StressVector<D> stress = cellLaw().pointwise * strain;
  if (pressure_) stress.template head<3>().array() += cellLaw().projected * pressure_->dilatation(u_, map_.place());
  return stress;
}

template class ElementStress<2>;
template class ElementStress<3>;

}  // namespace suture
