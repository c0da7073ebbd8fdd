#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/elasticity/HookesLaw.hpp>

namespace suture {

/// Places of the stresses of a bound among those of a HookesLaw.
template <int D>
constexpr std::array<int, BoundElement<D>::stress> stressPlaces() {
  if constexpr (D == 2)
    return {0, 1, 3};
  else
    return {0, 1, 2, 3, 4, 5};
}

/// Material data of the elements: the full law of displacements, whatever the form of the elements.
template <int D>
struct SimplexLaw {
  static constexpr int n = BoundElement<D>::stress;
  HookesLaw<D> ofElements, full;
  Eigen::Matrix<double, n, n> stiffness, compliance;
  bool isFull = false;  ///< true: the elements have the full law themselves

  SimplexLaw(Material material, PlaneModel plane) : ofElements(material, plane) {
    material.element = ElementForm::Displacement;
    material.enhanced = false;
    full = HookesLaw<D>(material, plane);
    isFull = ofElements.projected == 0.0 && ofElements.pointwise == full.pointwise;
    const auto c = stressPlaces<D>();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) stiffness(i, j) = full.pointwise(c[i], c[j]);
    if constexpr (D == 3) {
      compliance = full.compliance;
    } else {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          compliance(i, j) = full.compliance(c[i], c[j]);
          // In plane strain the out-of-plane stress follows from the others.
          if (!full.isSheet()) compliance(i, j) -= full.compliance(c[i], 2) * full.compliance(2, c[j]) / full.compliance(2, 2);
        }
    }
  }
};

}  // namespace suture
