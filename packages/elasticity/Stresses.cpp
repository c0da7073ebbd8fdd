#include <cmath>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

namespace suture {
namespace {
enum Column { XX = 0, YY = 1, ZZ = 2, XY = 3 };
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * ReferenceElement::maxNodes, 1>;
}  // namespace

Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement) {
  if (block.axisymmetric && plane == PlaneModel::Stress) throw InternalError("plane stress in an axisymmetric block");
  Matrix stresses(block.elements(), 4);
  const Material* last = nullptr;
  HookesLaw law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      law = HookesLaw(material, plane);
      last = &material;
    }
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Centroid);
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    map.at(0);
    Eigen::Vector4d strain = Eigen::Vector4d::Zero();
    ElementVector u(2 * reference.nodes);
    for (int a = 0; a < reference.nodes; ++a) {
      const double ux = u[2 * a] = displacement[2 * nodes[a]], uy = u[2 * a + 1] = displacement[2 * nodes[a] + 1];
      const double gx = map.gradient(a)[0], gy = map.gradient(a)[1];
      strain += Eigen::Vector4d(gx * ux, gy * uy, map.hoop(a) * ux, gy * ux + gx * uy);
    }
    Eigen::Vector4d s = law.pointwise * strain;
    if (law.projected != 0.0) {
      const ReferenceElement& whole = referenceElement(block.cells[e], stiffnessRule(block));
      ElementMap through(block, e, whole);
      s.head<3>().array() += law.projected * MixedPressure(block.cells[e], whole, through).dilatation(u, map.place());
    }
    stresses.row(e) = s.transpose();
  }
  return stresses;
}

Matrix principalStresses(const Matrix& stresses) {
  Matrix principal(stresses.rows(), 3);
  for (Eigen::Index i = 0; i < stresses.rows(); ++i) {
    const double mean = 0.5 * (stresses(i, XX) + stresses(i, YY)), half = 0.5 * (stresses(i, XX) - stresses(i, YY));
    const double radius = std::hypot(half, stresses(i, XY));  // of Mohr's circle
    principal.row(i) << mean + radius, mean - radius, 0.5 * std::atan2(stresses(i, XY), half);
  }
  return principal;
}

Vector vonMises(const Matrix& stresses) {
  Vector equivalent(stresses.rows());
  for (Eigen::Index i = 0; i < stresses.rows(); ++i) {
    const double a = stresses(i, XX) - stresses(i, YY), b = stresses(i, YY) - stresses(i, ZZ), c = stresses(i, ZZ) - stresses(i, XX);
    equivalent[i] = std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * stresses(i, XY) * stresses(i, XY));
  }
  return equivalent;
}

}  // namespace suture
