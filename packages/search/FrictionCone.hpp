#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Admissible forces of a pair with a linear friction law: { l : l_n >= 0, |l_t| <= bound + friction l_n }, component 0 along the normal.
/// Convex. An infinite bound admits any tangential force.
struct FrictionCone {
  double bound = 0.0;     ///< [force]
  double friction = 0.0;  ///< slope

  using Force = Eigen::Vector3d;
  using Derivative = Eigen::Matrix3d;

  /// Nearest point of the cone. \param derivative  derivative of the projection (an element of its generalised Jacobian), or null. Local.
  Force project(const Force& trial, Derivative* derivative = nullptr) const;
};

}  // namespace suture
