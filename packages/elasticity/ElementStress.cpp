#include <suture/elasticity/ElementStress.hpp>

namespace suture {

ElementStress::ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw& law,
                             const Vector& displacement)
    : law_(law), map_(block, element, reference), u_(2 * reference.nodes) {
  const Span<const int> nodes = block.nodesOf(element);
  for (int a = 0; a < reference.nodes; ++a)
    for (int k = 0; k < 2; ++k) u_[2 * a + k] = displacement[2 * nodes[a] + k];
  if (law_.projected == 0.0) return;
  const ReferenceElement& whole = referenceElement(block.cells[element], stiffnessRule(block));
  ElementMap through(block, element, whole);
  pressure_.emplace(block.cells[element], whole, through);
}

Eigen::Vector4d ElementStress::stress() const {
  Eigen::Vector4d strain = Eigen::Vector4d::Zero();
  for (Eigen::Index a = 0; 2 * a < u_.size(); ++a) {
    const double ux = u_[2 * a], uy = u_[2 * a + 1], gx = map_.gradient(int(a))[0], gy = map_.gradient(int(a))[1];
    strain += Eigen::Vector4d(gx * ux, gy * uy, map_.hoop(int(a)) * ux, gy * ux + gx * uy);
  }
  Eigen::Vector4d stress = law_.pointwise * strain;
  if (pressure_) stress.head<3>().array() += law_.projected * pressure_->dilatation(u_, map_.place());
  return stress;
}

}  // namespace suture
