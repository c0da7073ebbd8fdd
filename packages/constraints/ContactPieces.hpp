#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/ContactLine.hpp>
#include <suture/constraints/pairing/ContactPairs.hpp>

#include <vector>

namespace suture {

/// Connected components of Gamma_c: pairs that follow each other on a chain are connected, and so are pairs of lines with the same bodies A
/// and B that share a node. Numbered in the order of their first pairs; sets ContactPair::piece. Local.
/// \param lines   those that were paired;  \param paired  one for each
/// \param pairs   all pairs, numbered over the whole scene, in the order of the lines
std::vector<ContactPiece> findPieces(const std::vector<ContactLine>& lines, const std::vector<PairedLine>& paired,
                                     std::vector<ContactPair>& pairs);

}  // namespace suture
