#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/pairing/ContactPairs.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <vector>

namespace suture {

/// Connected components of Gamma_c: pairs of one cell are connected, and so are pairs of the same bodies on side A and on side B that share
/// a node, of different contacts, too. Numbered in the order of their first pairs; sets ContactPair::piece. Local.
/// \param contacts  those that were paired;  \param paired  one for each
/// \param pairs   all pairs, numbered over the whole scene, in the order of the contacts
std::vector<ContactPiece> findPieces(const Mesh& mesh, const std::vector<ContactSurface>& contacts,
                                     const std::vector<PairedSurface>& paired, std::vector<ContactPair>& pairs);

}  // namespace suture
