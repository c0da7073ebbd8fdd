#pragma once
#include <suture/report/answers/Probes.hpp>

#include <array>
#include <limits>
#include <vector>

namespace suture {

/// Values at a point of a probe. Trivially copyable, since it is sent as bytes.
struct ProbeValue {
  GlobalId order = 0;  ///< number of the point, or of the node in the mesh
  int body = -1, unused = 0;
  double arc = 0.0;                             ///< distance from the first point, along the sides of a group [length]
  Point place{0, 0, 0}, displacement{0, 0, 0};  ///< undeformed [length]
  std::array<double, 6> stress{};               ///< xx, yy, zz, xy, yz, xz; in 2D the last two are zero [stress]
  double gap = std::numeric_limits<double>::quiet_NaN(), pressure = gap;  ///< NaN where the point carries no pair [length, stress]
};

/// The values of probes: one list per probe, on rank 0; empty lists elsewhere. Collective.
/// \param nodal  recovered stresses of each mesh, which are interpolated; empty: stresses at the centroids of the elements
/// \throws InputError  as locateProbes()
std::vector<std::vector<ProbeValue>> probeValues(const Run& run, const std::vector<Probe>& probes, const std::vector<Matrix>& nodal);

/// Invariants of the stress at a point [stress].
struct PrincipalExtremes {
  double vonMises, largest, smallest;
};
PrincipalExtremes principalExtremes(const ProbeValue& value, int dimension);

}  // namespace suture
