#include <suture/answer/bound/PressedSides.hpp>
#include <suture/answer/bound/SupportedSides.hpp>

namespace suture {

template <int D>
std::optional<SupportForm> supportForm(const StarMesh<D>& mesh, int s, const Vector& tractions) {
  const SideCondition<D>* side = mesh.boundaryOf(s);
  if (!side || !side->isSupported()) return std::nullopt;
  const int count = SimplexNodes<D>::sideNodes(mesh.degree());
  const Matrix mass = mesh.size(s) * sideMass(D, mesh.degree());
  SupportForm form{Matrix::Zero(D * count, D * count), Vector::Zero(D * count)};
  for (int k = 0; k < D; ++k) {
    if (!(side->compliance[k] > 0.0)) continue;
    const Eigen::Matrix<double, D, 1> axis = side->axes.row(k).transpose();
    Vector deviation(count);
    for (int j = 0; j < count; ++j)
      deviation[j] =
          axis.dot(tractions.template segment<D>(D * j) - side->traction.col(j)) + axis.dot(side->moved.col(j)) / side->compliance[k];
    const Vector weighted = side->compliance[k] * (mass * deviation);
    form.energy += deviation.dot(weighted);
    for (int i = 0; i < count; ++i) {
      form.product.template segment<D>(D * i) += weighted[i] * axis;
      for (int j = 0; j < count; ++j)
        form.gram.template block<D, D>(D * i, D * j) += side->compliance[k] * mass(i, j) * axis * axis.transpose();
    }
  }
  return form;
}

template <int D>
double addSupports(const StarMesh<D>& mesh, int e, const Vector& data, Matrix& gram, Vector& product) {
  const int count = D * SimplexNodes<D>::sideNodes(mesh.degree());
  double energy = 0.0;
  for (int a = 0; a <= D; ++a) {
    const std::optional<SupportForm> form = supportForm<D>(mesh, mesh.sidesOfElement(e)[a], data.segment(a * count, count));
    if (!form) continue;
    energy += form->energy;
    product.segment(a * count, count) += form->product;
    gram.block(a * count, a * count, count, count) += form->gram;
  }
  return energy;
}

template <int D>
double supportEnergy(const SideCondition<D>& side, int degree, double size, const Eigen::Matrix<double, D, 6>& moved) {
  const int count = SimplexNodes<D>::sideNodes(degree);
  double energy = 0.0;
  for (int k = 0; k < D; ++k) {
    if (!(side.compliance[k] > 0.0)) continue;
    const Vector along = (side.axes.row(k) * moved.leftCols(count)).transpose();
    energy += size / side.compliance[k] * along.dot(sideMass(D, degree) * along);
  }
  return energy;
}

template std::optional<SupportForm> supportForm(const StarMesh<2>&, int, const Vector&);
template std::optional<SupportForm> supportForm(const StarMesh<3>&, int, const Vector&);
template double addSupports(const StarMesh<3>&, int, const Vector&, Matrix&, Vector&);
template double supportEnergy(const SideCondition<2>&, int, double, const Eigen::Matrix<double, 2, 6>&);
template double supportEnergy(const SideCondition<3>&, int, double, const Eigen::Matrix<double, 3, 6>&);

}  // namespace suture
