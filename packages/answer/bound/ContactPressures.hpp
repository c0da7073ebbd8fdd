#pragma once
#include <suture/answer/bound/GapLift.hpp>
#include <suture/answer/bound/PressedSides.hpp>

namespace suture {

/// Pressures p >= 0 on the sides of a contact that balance its nodal forces: statically admissible contact tractions.
struct Pressures {
  Matrix values;             ///< sideNodes x sides: nodal values of p on each side, p discontinuous between sides [force / size of a side]
  std::vector<double> rest;  ///< force minus moment of p at each node; zero except in clusters [force]
  std::vector<std::vector<int>> clusters;  ///< sets of nodes where only resultants fit; in each the rest is self-balanced
  double misfit = 0.0;    ///< largest |force - moment| at nodes outside of clusters, relative to the largest force: round-off if feasible
  bool feasible = false;  ///< false: some resultant is not that of any p >= 0
};

/// Polynomials p >= 0, at most `limit`, of the sides' degree whose moments, integrals of p phi_j, equal the nodal forces: Bernstein
/// coefficients c >= 0, closest to a smooth estimate of the pressure. Where no such p exists, clusters of nodes appear: there the sum and
/// the first moments of `rest` vanish (2D: one moment; 3D: two, for sides in a plane; both for sides on one straight line or plane), and
/// the sum of the amplitudes of its elementary self-balanced patterns is minimal. Clusters are connected by patterns and disjoint.
///
/// With a limit, p <= limit likewise, and p equals it on sides where a node has the largest force that p <= limit can balance. Pressures
/// of any sign (`mayPull`) always exist.
///
/// p can be positive on sides all of whose mid-edge nodes (degree 1: all vertices) have a compressive force; others cannot carry p >= 0
/// exactly. Clusters may also use sides with at least one loaded node. Forces below 1e-13 of the largest count as zero.
/// Connected parts of the contact are independent of each other. Deterministic. Local.
/// \throws InternalError  for invalid sides
Pressures admissiblePressures(const PressedSides& sides);

}  // namespace suture
