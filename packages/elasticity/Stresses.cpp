#include <cmath>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {
namespace {
enum Column { XX = 0, YY = 1, ZZ = 2, XY = 3 };
}  // namespace

Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement, const InitialState& initial) {
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
    ElementStress element(block, e, referenceElement(block.cells[e], Rule::Centroid), law, displacement, initial);
    element.at(0);
    stresses.row(e) = element.stress().transpose();
  }
  return stresses;
}

Matrix elementStresses(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement) {
  const auto materialOf = [&](int e) -> const Material& { return model.materialOf(mesh, e, mesh.body); };
  return elementStresses(mesh, materialOf, model.plane, displacement, InitialState(model, mesh.body));
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
