#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Forces and jumps of pairs in equilibrium with the loads: a solution of a linear problem, or a combination of several.
struct ContactBalance {
  Matrix force;           ///< pairs x 3 [force]
  Matrix jump;            ///< pairs x 3: penetration and slip [length]
  double distance = 0.0;  ///< from the laws (LawProjection::distance) [energy]

  /// The balance at `part` of the way to another one; its distance is not set.
  ContactBalance towards(const Matrix& otherForce, const Matrix& otherJump, double part) const {
    return {force + part * (otherForce - force), jump + part * (otherJump - jump)};
  }
};

}  // namespace suture
