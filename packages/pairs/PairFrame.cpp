#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <cmath>

namespace suture {

namespace {
constexpr double kTie = 1e-6;  // difference up to which two components count as equal
}

std::vector<Point> pairFrame(const Point& normal, int dimension) {
  if (dimension == 2) return {normal, turned(normal)};
  // Uses the axis farthest from the normal, to avoid cancellation; of equal components the first, independently of round-off.
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) < std::abs(normal[least]) - kTie) least = k;
  Point axis{0, 0, 0};
  axis[least] = 1.0;
  const Point across = cross(normal, axis), first = scaled(1.0 / norm(across), across);
  return {normal, first, cross(normal, first)};
}

std::vector<Point> pairFrame(const ContactPair& pair, int dimension) {
  if (dimension == 2 || pair.still.size() != 1) return pairFrame(pair.normal, dimension);
  return {pair.normal, cross(pair.still[0], pair.normal), pair.still[0]};
}

}  // namespace suture
