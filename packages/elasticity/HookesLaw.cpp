#include <suture/elasticity/HookesLaw.hpp>

namespace suture {

HookesLaw::HookesLaw(const Material& material, PlaneModel plane) : HookesLaw() {
  if (plane == PlaneModel::Stress) {
    const Matrix d = elasticity(material, plane, 2);
    const int at[] = {0, 1, 3};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) pointwise(at[i], at[j]) = d(i, j);
    return;
  }
  pointwise = elasticity(material, plane, 3).topLeftCorner<4, 4>();
  if (material.element != ElementForm::Mixed) return;
  projected = pointwise(0, 1);
  pointwise.topLeftCorner<3, 3>().array() -= projected;
}

}  // namespace suture
