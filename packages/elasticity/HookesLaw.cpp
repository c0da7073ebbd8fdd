#include <suture/elasticity/HookesLaw.hpp>

#include <Eigen/LU>

namespace suture {

HookesLaw::HookesLaw(const Material& material, PlaneModel plane) : HookesLaw() {
  expansion = material.expansion.value_or(0.0);
  const ElasticStiffness c = material.stiffness();
  if (material.law) {
    compliance = c.inverse().topLeftCorner<4, 4>();
  } else {  // in closed form: near nu = 0.5 an inverse has few digits
    compliance.topLeftCorner<3, 3>().setConstant(-material.poisson / material.young);
    compliance.diagonal().head<3>().setConstant(1.0 / material.young);
    compliance(3, 3) = 2.0 * (1.0 + material.poisson) / material.young;
  }
  if (plane == PlaneModel::Stress) {
    const Matrix d = elasticity(material, plane, 2);
    const int at[] = {0, 1, 3};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) pointwise(at[i], at[j]) = d(i, j);
    return;
  }
  pointwise = c.topLeftCorner<4, 4>();
  if (material.element != ElementForm::Mixed) return;
  projected = meanCoupling(c);
  pointwise.topLeftCorner<3, 3>().array() -= projected;
}

}  // namespace suture
