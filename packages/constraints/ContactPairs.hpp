#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/ContactLine.hpp>

#include <vector>

namespace suture {

/// Pairs the nodes of a contact line's two sides, ordered along side A (its body on the left). Local.
///
/// The sides must match: as many connected chains, facing chains with as many nodes, met in opposite order. Partners may stand apart by an
/// initial gap, but not be shifted along the line: with n = (n_A - n_B) / |n_A - n_B|, d = x_B - x_A and gap d.n, the tangential distance
/// must be at most
///     tolerance x local mesh size + |gap| tan(theta),
/// where theta is the largest angle between n and the normals of the sides nearby. The second term lets d lie anywhere between the normals
/// of the two sides: with a gap between curved sides no single direction is the right one (a cylinder over a plane matches by x, one over
/// a cylinder by angle), and the difference is of second order.
/// \param problems  gets sides that do not match (how many nodes on each, how many without partner, where and how far) or do not face each
/// other \return pairs with ids from 0; `chainStart` gets the index of the first pair of each chain, and whether the chain is closed
struct PairedLine {
  std::vector<ContactPair> pairs;
  struct Chain {
    int first, count;
    bool closed;
  };
  std::vector<Chain> chains;
};
PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems);

}  // namespace suture
