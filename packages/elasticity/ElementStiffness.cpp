#include <array>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {
namespace {

constexpr int maxDofs = 2 * ReferenceElement::maxNodes;
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, maxDofs, maxDofs>;

// K += sum over points of B^T D B, of which only the blocks a <= b are computed: exactly symmetric. B of node a (Voigt: xx, yy, xy) is
// [gx 0; 0 gy; gy gx].
void addStiffness(const CellBlock& block, int element, const ReferenceElement& reference, const Eigen::Matrix3d& d, ElementMatrix& k) {
  ElementMap map(block, element, reference);
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Eigen::Matrix3d scaled = map.measure() * d;
    for (int b = 0; b < reference.nodes; ++b) {
      const double gx = map.gradient(b)[0], gy = map.gradient(b)[1];
      const Eigen::Vector3d stressX = scaled.col(0) * gx + scaled.col(2) * gy;
      const Eigen::Vector3d stressY = scaled.col(1) * gy + scaled.col(2) * gx;
      for (int a = 0; a <= b; ++a) {
        const double hx = map.gradient(a)[0], hy = map.gradient(a)[1];
        k(2 * a, 2 * b) += hx * stressX[0] + hy * stressX[2];
        k(2 * a, 2 * b + 1) += hx * stressY[0] + hy * stressY[2];
        k(2 * a + 1, 2 * b) += hy * stressX[1] + hx * stressX[2];
        k(2 * a + 1, 2 * b + 1) += hy * stressY[1] + hx * stressY[2];
      }
    }
  }
  const int n = 2 * reference.nodes;
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) k(i, j) = k(j, i);
}

}  // namespace

void elementStiffnesses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take) {
  if (block.dimension != 2) throw InternalError("element stiffness in dimension " + std::to_string(block.dimension));
  const Material* last = nullptr;
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  ElementMatrix k;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      d = elasticity(material, plane, 2);
      last = &material;
    }
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Stiffness);
    k.setZero(2 * reference.nodes, 2 * reference.nodes);
    addStiffness(block, e, reference, d, k);
    take(e, k);
  }
}

void elementStiffnesses(const CellBlock& block, const Material& material, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take) {
  elementStiffnesses(
      block, [&material](int) -> const Material& { return material; }, plane, take);
}

}  // namespace suture
