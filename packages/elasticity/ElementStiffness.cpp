#include <array>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

namespace suture {
namespace {

constexpr int maxDofs = 2 * ReferenceElement::maxNodes;
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, maxDofs, maxDofs>;

// K += sum over points of B^T D B, of which only the blocks a <= b are computed: exactly symmetric. B of node a (xx, yy, zz, xy) is
// [gx 0; 0 gy; h 0; gy gx], h the hoop strain N / r, of axisymmetric blocks only.
template <bool hoop>
void addPointwise(const ReferenceElement& reference, const Eigen::Matrix4d& d, ElementMap& map, ElementMatrix& k) {
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Eigen::Matrix4d scaled = map.measure() * d;
    for (int b = 0; b < reference.nodes; ++b) {
      const double gx = map.gradient(b)[0], gy = map.gradient(b)[1];
      Eigen::Vector4d stressX = scaled.col(0) * gx + scaled.col(3) * gy;
      const Eigen::Vector4d stressY = scaled.col(1) * gy + scaled.col(3) * gx;
      if constexpr (hoop) stressX += scaled.col(2) * map.hoop(b);
      for (int a = 0; a <= b; ++a) {
        const double hx = map.gradient(a)[0], hy = map.gradient(a)[1];
        k(2 * a, 2 * b) += hx * stressX[0] + hy * stressX[3];
        k(2 * a, 2 * b + 1) += hx * stressY[0] + hy * stressY[3];
        k(2 * a + 1, 2 * b) += hy * stressX[1] + hx * stressX[3];
        k(2 * a + 1, 2 * b + 1) += hy * stressY[1] + hx * stressY[3];
        if constexpr (hoop) {
          k(2 * a, 2 * b) += map.hoop(a) * stressX[2];
          k(2 * a, 2 * b + 1) += map.hoop(a) * stressY[2];
        }
      }
    }
  }
}

void addStiffness(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw& law, ElementMatrix& k) {
  ElementMap map(block, element, reference);
  if (block.axisymmetric)
    addPointwise<true>(reference, law.pointwise, map, k);
  else
    addPointwise<false>(reference, law.pointwise, map, k);
  if (law.projected != 0.0) MixedPressure(block.cells[element], reference, map).addStiffness(law.projected, k);
  const int n = 2 * reference.nodes;
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) k(i, j) = k(j, i);
}

}  // namespace

void elementStiffnesses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take) {
  if (block.dimension != 2) throw InternalError("element stiffness in dimension " + std::to_string(block.dimension));
  if (block.axisymmetric && plane == PlaneModel::Stress) throw InternalError("plane stress in an axisymmetric block");
  const Material* last = nullptr;
  HookesLaw law;
  ElementMatrix k;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      law = HookesLaw(material, plane);
      last = &material;
    }
    const ReferenceElement& reference = referenceElement(block.cells[e], stiffnessRule(block));
    k.setZero(2 * reference.nodes, 2 * reference.nodes);
    addStiffness(block, e, reference, law, k);
    take(e, k);
  }
}

void elementStiffnesses(const CellBlock& block, const Material& material, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take) {
  elementStiffnesses(
      block, [&material](int) -> const Material& { return material; }, plane, take);
}

}  // namespace suture
