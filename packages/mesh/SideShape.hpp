#pragma once
#include <suture/base/Types.hpp>

#include <array>

namespace suture {

/// Shape functions of a side's nodes (end points first, then the middle) on [-1, 1], and their derivatives. \param nodes  2 or 3. Local.
struct SideShape {
  std::array<double, 3> value{}, slope{};
};
SideShape sideShape(int nodes, double xi);

/// Gauss-Legendre rule on [-1, 1]: exact for polynomials up to degree 2 points - 1. Local.
struct LineRule {
  Vector points, weights;
};
LineRule gaussRule(int points);

}  // namespace suture
