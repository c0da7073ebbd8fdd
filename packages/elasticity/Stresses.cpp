#include <cmath>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {
namespace {
enum Column { XX = 0, YY = 1, ZZ = 2, XY = 3 };
}

Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement) {
  Matrix stresses(block.elements(), 4);
  const Material* last = nullptr;
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      d = elasticity(material, plane, 2);
      last = &material;
    }
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Centroid);
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    map.at(0);
    Eigen::Vector3d strain = Eigen::Vector3d::Zero();
    for (int a = 0; a < reference.nodes; ++a) {
      const double ux = displacement[2 * nodes[a]], uy = displacement[2 * nodes[a] + 1];
      const double gx = map.gradient(a)[0], gy = map.gradient(a)[1];
      strain += Eigen::Vector3d(gx * ux, gy * uy, gy * ux + gx * uy);
    }
    const Eigen::Vector3d s = d * strain;
    // Plane strain: no strain across, hence a stress; plane stress: none.
    const double across = plane == PlaneModel::Strain ? material.poisson * (s[0] + s[1]) : 0.0;
    stresses.row(e) << s[0], s[1], across, s[2];
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
