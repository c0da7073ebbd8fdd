#pragma once
#include <suture/pairs/ContactPairs.hpp>
#include <suture/pairs/ContactPiece.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <vector>

namespace suture {

/// Connected components of Gamma_c: pairs of one cell are connected, and so are pairs (also of different contacts) of the same bodies on
/// sides A and B that share a node. Numbered in the order of their first pairs; sets ContactPair::piece. Local.
/// \param contacts  the paired contacts;  \param paired  one per contact
/// \param pairs   all pairs, numbered over the whole scene, in the order of the contacts
std::vector<ContactPiece> findPieces(const Mesh& mesh, const std::vector<ContactSurface>& contacts,
                                     const std::vector<PairedSurface>& paired, std::vector<ContactPair>& pairs);

}  // namespace suture
