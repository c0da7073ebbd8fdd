#include <Eigen/LU>
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/elasticity/ElementStress.hpp>

namespace suture {

template <int D>
BoundedField<D>::BoundedField(const BoundedSolution& solution, int m, const BoundKind& kind, std::set<std::string>& reasons)
    : solution_(solution),
      mesh_(solution.meshes[m]),
      kind_(kind),
      reasons_(reasons),
      displacement_(solution.displacement[m]),
      initial_(solution.model, mesh_.body),
      sources_(mesh_, solution.model, kind, reasons) {
  if (solution.balancing && solution.balancing->correction[m].size() > 0) balanced_ = displacement_ + solution.balancing->correction[m];
}

template <int D>
const SimplexLaw<D>& BoundedField<D>::lawOf(int element) {
  const Material& material = solution_.model.materialOf(mesh_, element, mesh_.body);
  const bool isMixed = material.element == ElementForm::Mixed && !(material.enhanced && mayBeEnhanced(mesh_.cells[element]));
  if (&material == lastMaterial_ && isMixed == lastIsMixed_) return *lastLaw_;
  auto& law = laws_[&material];
  lastIsMixed_ = isMixed;
  if (isMixed) remark("elements have a separate pressure (Mixed), which differs from that of their displacements");
  if (!law) law = std::make_unique<SimplexLaw<D>>(material, solution_.model.plane);
  lastMaterial_ = &material;
  lastLaw_ = law.get();
  return *law;
}

template <int D>
typename BoundedField<D>::Forces BoundedField<D>::nodalOf(int element, const Vector& values) const {
  const Span<const int> all = mesh_.nodesOf(element);
  Forces nodal(D, int(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) nodal.col(int(i)) = values.template segment<D>(D * Eigen::Index(all[i]));
  return nodal;
}

template <int D>
typename BoundedField<D>::Forces BoundedField<D>::forcesOf(int element, const Vector& displacement, const InitialState& initial,
                                                           const SimplexLaw<D>& law) const {
  Forces forces = Forces::Zero(D, int(mesh_.nodesOf(element).size()));
  const ReferenceElement& reference = stiffnessElement(mesh_, element);
  ElementStress<D> stress(mesh_, element, reference, law.ofElements, displacement, initial);
  for (int q = 0; q < reference.points; ++q) {
    stress.at(q);
    const StressVector<D> s = stress.map().measure() * stress.stress();
    for (int i = 0; i < int(forces.cols()); ++i) forces.col(i) += forceOfStress<D>(stress.map().gradient(i), s);
  }
  return forces;
}

template <int D>
LinearStress BoundedField<D>::linearStressOf(int element, const SimplexLaw<D>& law, Eigen::Vector3d& centroid) const {
  LinearStress result = LinearStress::Zero();
  centroid.setZero();
  if constexpr (D == 3) {
    const ReferenceElement& reference = stiffnessElement(mesh_, element);
    ElementStress<3> stress(mesh_, element, reference, law.ofElements, displacement_, initial_);
    double volume = 0.0;
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 6, 3> moments = Eigen::Matrix<double, 6, 3>::Zero();
    const Point first = stress.map().node(0);
    const Eigen::Vector3d origin(first[0], first[1], first[2]);
    for (int q = 0; q < reference.points; ++q) {
      stress.at(q);
      const double measure = stress.map().measure();
      const Point p = stress.map().place();
      const Eigen::Vector3d arm = Eigen::Vector3d(p[0], p[1], p[2]) - origin;
      const StressVector<3> s = measure * stress.stress();
      volume += measure;
      centroid += measure * arm;
      second += measure * arm * arm.transpose();
      result.col(0) += s;
      moments += s * arm.transpose();
    }
    centroid /= volume;
    second -= volume * centroid * centroid.transpose();
    moments -= result.col(0) * centroid.transpose();
    result.col(0) /= volume;
    if (kind_.order == 2) result.rightCols<3>() = moments * second.inverse();
    centroid += origin;
  }
  return result;
}

template <int D>
void BoundedField<D>::addInitialStress(int element, const SimplexLaw<D>& law, BoundElement<D>& simplex) const {
  const auto c = stressPlaces<D>();
  for (int q = 0; q <= D; ++q) {
    Point at{0, 0, 0};
    const Eigen::Matrix<double, D, 1> place = kind_.degree == 1 ? Eigen::Matrix<double, D, 1>(simplex.places.rowwise().mean())
                                                                : Eigen::Matrix<double, D, 1>(simplex.places.col(q));
    for (int k = 0; k < D; ++k) at[k] = place[k];
    const auto values = initial_.template at<D>(element, at, law.full);
    const StressVector<D> stress = values.stress - law.full.pointwise * values.strain;
    for (int i = 0; i < BoundElement<D>::stress; ++i) simplex.stresses(i, q) += stress[c[i]];
  }
}

template class BoundedField<2>;
template class BoundedField<3>;

}  // namespace suture
