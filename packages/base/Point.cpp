#include <suture/base/Point.hpp>

namespace suture {

Point unit(const Point& a) {
  constexpr double rounding = 1e-9;
  Point u = a;
  const double length = norm(a);
  bool changed = false;
  for (double& x : u) {
    x /= length;
    if (std::abs(x) > rounding) continue;
    changed = changed || x != 0.0;
    x = 0.0;
  }
  if (!changed) return u;
  const double rest = norm(u);
  for (double& x : u) x /= rest;
  return u;
}

}  // namespace suture
