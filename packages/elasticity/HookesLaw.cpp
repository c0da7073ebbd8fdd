#include <suture/elasticity/HookesLaw.hpp>

#include <Eigen/LU>

namespace suture {

template <int D>
HookesLaw<D>::HookesLaw(const Material& material, PlaneModel plane) : HookesLaw() {
  constexpr int n = stressComponents<D>;
  expansion = material.expansion.value_or(0.0);
  enhanced = material.enhanced;
  const ElasticStiffness c = material.stiffness();
  if (D == 2 && material.law) planePart(c);  // throws
  if (material.law) {
    compliance = c.inverse().topLeftCorner<n, n>();
  } else {  // in closed form: near nu = 0.5 an inverse loses digits
    compliance.template topLeftCorner<3, 3>().setConstant(-material.poisson / material.young);
    compliance.diagonal().template head<3>().setConstant(1.0 / material.young);
    compliance.diagonal().template tail<n - 3>().setConstant(2.0 * (1.0 + material.poisson) / material.young);
  }
  if (D == 2 && plane == PlaneModel::Stress) {
    const Matrix d = elasticity(material, plane, 2);
    const int at[] = {0, 1, 3};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) pointwise(at[i], at[j]) = d(i, j);
    return;
  }
  pointwise = c.topLeftCorner<n, n>();
  if (material.element != ElementForm::Mixed) return;
  projected = meanCoupling(c);
  pointwise.template topLeftCorner<3, 3>().array() -= projected;
}

template <int D>
HookesLaw<D> HookesLaw<D>::of(Cell cell) const {
  HookesLaw<D> own = *this;
  own.enhanced = enhanced && mayBeEnhanced(cell);
  if (!own.enhanced || projected == 0.0) return own;
  own.pointwise.template topLeftCorner<3, 3>().array() += projected;
  own.projected = 0.0;
  return own;
}

template HookesLaw<2>::HookesLaw(const Material&, PlaneModel);
template HookesLaw<3>::HookesLaw(const Material&, PlaneModel);
template HookesLaw<2> HookesLaw<2>::of(Cell) const;
template HookesLaw<3> HookesLaw<3>::of(Cell) const;

}  // namespace suture
