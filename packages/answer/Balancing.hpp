#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairs/PairForce.hpp>

#include <map>
#include <vector>

namespace suture {

/// A correction w of the displacements u, which jumps between subdomains, such that the element forces of u + w balance up to round-off at
/// each node: with the loads, the reactions of supports and `forces`, summed over the subdomains of the node. It exists for any accuracy of
/// the interface solve. The energy norm of the error of u against the exact finite element solution with the same pair states is at most
/// sqrt(energy).
struct Balancing {
  /// w of each subdomain mesh of this rank, node-major, Cartesian, as Solution::displacement; empty vectors: zero. [length]
  std::vector<Vector> correction;
  double energy = 0.0;  ///< sum over the subdomains of |w_s|^2 in the norm of K_s, over all ranks [force x length]
  /// Forces of u + w at the contact rows of this rank's meshes, by pair id. Those in Solution::pairs are the forces of u; both differ by
  /// the order of the algebraic error.
  std::map<int, PairForce> forces;
  double imbalance = 0.0;  ///< largest unbalanced force at an interface unknown relative to the largest force there
};

}  // namespace suture
