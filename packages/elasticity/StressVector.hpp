#pragma once
#include <Eigen/Core>

namespace suture {

/// Stresses and strains as vectors, in the order (xx, yy, zz, xy, yz, xz), with engineering shear strains (2 e_xy). 2D and axisymmetric
/// scenes (D = 2) use the first four: zz is the out-of-plane or hoop component.
template <int D>
constexpr int stressComponents = D == 2 ? 4 : 6;

template <int D>
using StressVector = Eigen::Matrix<double, stressComponents<D>, 1>;
template <int D>
using StressMatrix = Eigen::Matrix<double, stressComponents<D>, stressComponents<D>>;

/// First and second axis of each component of a stress.
constexpr int kStressAxes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};

/// B^T s: nodal force of a stress for a shape function with the given gradient.
template <int D>
inline Eigen::Matrix<double, D, 1> forceOfStress(const double* gradient, const StressVector<D>& s) {
  const double gx = gradient[0], gy = gradient[1];
  if constexpr (D == 2) {
    return {gx * s[0] + gy * s[3], gy * s[1] + gx * s[3]};
  } else {
    const double gz = gradient[2];
    return {gx * s[0] + gy * s[3] + gz * s[5], gy * s[1] + gx * s[3] + gz * s[4], gz * s[2] + gy * s[4] + gx * s[5]};
  }
}

}  // namespace suture
