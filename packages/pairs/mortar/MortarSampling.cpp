#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/FaceSampling.hpp>
#include <suture/pairs/mortar/LineSampling.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

#include <algorithm>

namespace suture {

std::vector<int> rimOf(const Surface& surface) {
  std::vector<int> rim;
  for (int side = 0; side < surface.sides(); ++side)
    for (int k = 0; k < surface.facets(side); ++k) {
      if (surface.across(side, k).side >= 0) continue;
      const std::vector<int>& nodes = surface.nodesOf(side);
      rim.push_back(nodes[k]);
      if (surface.dimension() == 2) continue;
      rim.push_back(nodes[(k + 1) % surface.facets(side)]);
      if (static_cast<int>(nodes.size()) > surface.facets(side)) rim.push_back(nodes[surface.facets(side) + k]);
    }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

Point rowNormalOf(const Point& own, const Point& facing, bool isOnRim) {
  constexpr double kAntiparallel = 1e-9;  // sine of the angle
  if (norm(cross(own, facing)) <= kAntiparallel) return own;
  return isOnRim ? scaled(-1.0, facing) : unit(minus(own, facing));
}

std::unique_ptr<MortarSampling> samplingOf(const Mesh& mesh, const ContactSurface& contact, bool onA) {
  if (mesh.dimension == 2) return std::make_unique<LineSampling>(mesh, contact, onA);
  return std::make_unique<FaceSampling>(mesh, contact, onA);
}

}  // namespace suture
