#include <Eigen/Eigenvalues>
#include <cmath>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {
namespace {

enum Column { XX = 0, YY = 1, ZZ = 2, XY = 3 };

template <int D>
Matrix stressesOf(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                  const Vector& displacement, const InitialState& initial) {
  Matrix stresses(block.elements(), stressComponents<D>);
  const Material* last = nullptr;
  HookesLaw<D> law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      law = HookesLaw<D>(material, plane);
      last = &material;
    }
    ElementStress<D> element(block, e, referenceElement(block.cells[e], Rule::Centroid), law, displacement, initial);
    element.at(0);
    stresses.row(e) = element.stress().transpose();
  }
  return stresses;
}

}  // namespace

Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement, const InitialState& initial) {
  if (block.axisymmetric && plane == PlaneModel::Stress) throw InternalError("plane stress in an axisymmetric block");
  return block.dimension == 2 ? stressesOf<2>(block, materialOf, plane, displacement, initial)
                              : stressesOf<3>(block, materialOf, plane, displacement, initial);
}

Matrix elementStresses(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement) {
  const auto materialOf = [&](int e) -> const Material& { return model.materialOf(mesh, e, mesh.body); };
  return elementStresses(mesh, materialOf, model.plane, displacement, InitialState(model, mesh.body));
}

namespace {

// Both in-plane principal stresses, by Mohr's circle.
Matrix principalInPlane(const Matrix& stresses) {
  Matrix principal(stresses.rows(), 3);
  for (Eigen::Index i = 0; i < stresses.rows(); ++i) {
    const double mean = 0.5 * (stresses(i, XX) + stresses(i, YY)), half = 0.5 * (stresses(i, XX) - stresses(i, YY));
    const double radius = std::hypot(half, stresses(i, XY));
    principal.row(i) << mean + radius, mean - radius, 0.5 * std::atan2(stresses(i, XY), half);
  }
  return principal;
}

// A direction with its largest component positive, independent of the sign of the computed eigenvector.
Eigen::RowVector3d directed(const Eigen::Vector3d& direction) {
  Eigen::Index largest;
  direction.cwiseAbs().maxCoeff(&largest);
  return (direction[largest] < 0.0 ? -direction : direction).transpose();
}

Matrix principalInSpace(const Matrix& stresses) {
  Matrix principal(stresses.rows(), 9);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  for (Eigen::Index i = 0; i < stresses.rows(); ++i) {
    Eigen::Matrix3d tensor;
    for (int c = 0; c < 6; ++c)
      tensor(kStressAxes[c][0], kStressAxes[c][1]) = tensor(kStressAxes[c][1], kStressAxes[c][0]) = stresses(i, c);
    solver.compute(tensor);
    principal.row(i) << solver.eigenvalues().reverse().transpose(), directed(solver.eigenvectors().col(2)),
        directed(solver.eigenvectors().col(0));
  }
  return principal;
}

}  // namespace

Matrix principalStresses(const Matrix& stresses) {
  return stresses.cols() == stressComponents<2> ? principalInPlane(stresses) : principalInSpace(stresses);
}

Vector vonMises(const Matrix& stresses) {
  Vector equivalent(stresses.rows());
  for (Eigen::Index i = 0; i < stresses.rows(); ++i) {
    const double a = stresses(i, XX) - stresses(i, YY), b = stresses(i, YY) - stresses(i, ZZ), c = stresses(i, ZZ) - stresses(i, XX);
    double shear = stresses(i, XY) * stresses(i, XY);
    for (Eigen::Index k = XY + 1; k < stresses.cols(); ++k) shear += stresses(i, k) * stresses(i, k);
    equivalent[i] = std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * shear);
  }
  return equivalent;
}

}  // namespace suture
