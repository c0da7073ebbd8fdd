#include <suture/base/Point.hpp>
#include <suture/constraints/PairFrame.hpp>

#include <cmath>

namespace suture {

std::vector<Point> pairFrame(const Point& normal, int dimension) {
  if (dimension == 2) return {normal, turned(normal)};
  // Beside the axis that is farthest from the normal: nothing cancels.
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
  Point axis{0, 0, 0};
  axis[least] = 1.0;
  const Point across = cross(normal, axis), first = scaled(1.0 / norm(across), across);
  return {normal, first, cross(normal, first)};
}

}  // namespace suture
