#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Gauss-Legendre rule on [-1, 1]: exact for polynomials up to degree 2 points - 1. Local.
struct LineRule {
  Vector points, weights;
};
LineRule gaussRule(int points);

}  // namespace suture
