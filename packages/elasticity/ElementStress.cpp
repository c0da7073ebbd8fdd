#include <suture/elasticity/ElementStress.hpp>

namespace suture {

ElementStress::ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw& law,
                             const Vector& displacement, const InitialState& initial)
    : element_(element),
      initial_(initial.isIn(element) ? &initial : nullptr),
      law_(law),
      map_(block, element, reference),
      u_(2 * reference.nodes),
      axisymmetric_(block.axisymmetric) {
  const Span<const int> nodes = block.nodesOf(element);
  for (int a = 0; a < reference.nodes; ++a)
    for (int k = 0; k < 2; ++k) u_[2 * a + k] = displacement[2 * nodes[a] + k];
  if (law_.projected == 0.0) return;
  const ReferenceElement& whole = referenceElement(block.cells[element], stiffnessRule(block));
  ElementMap through(block, element, whole);
  pressure_.emplace(block.cells[element], whole, through);
  if (initial_)
    initialDilatation_ = pressure_->projection(
        whole, through, [&](const Point& place) { return initial_->at(element_, place, law_).strain.head<3>().sum(); });
}

Eigen::Vector4d ElementStress::stress() const {
  Eigen::Vector4d stress = ofDisplacement();
  if (!initial_) return stress;
  const InitialState::Values here = initial();
  stress += here.stress - law_.pointwise * here.strain;
  if (pressure_) stress.head<3>().array() -= law_.projected * pressure_->at(initialDilatation_, map_.place());
  return stress;
}

Eigen::Vector4d ElementStress::ofDisplacement() const {
  const int nodes = static_cast<int>(u_.size()) / 2;
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0;  // one by one: they stay in registers
  for (int a = 0; a < nodes; ++a) {
    const double ux = u_[2 * a], uy = u_[2 * a + 1], gx = map_.gradient(a)[0], gy = map_.gradient(a)[1];
    xx += gx * ux;
    yy += gy * uy;
    xy += gy * ux + gx * uy;
  }
  if (axisymmetric_)
    for (int a = 0; a < nodes; ++a) zz += map_.hoop(a) * u_[2 * a];
  Eigen::Vector4d stress = law_.pointwise * Eigen::Vector4d(xx, yy, zz, xy);
  if (pressure_) stress.head<3>().array() += law_.projected * pressure_->dilatation(u_, map_.place());
  return stress;
}

}  // namespace suture
