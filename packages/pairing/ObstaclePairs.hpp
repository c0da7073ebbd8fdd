#pragma once
#include <suture/pairing/ContactPairs.hpp>

namespace suture {

/// Pairs of a contact whose partner is a rigid obstacle: one for each node of side A that has the obstacle in front, with the obstacle's
/// normal and distance there, or the side's (Contact::Direction). Nodes that see it more than 60 degrees aside, across a gap, make no pair:
/// a flat side beyond a bump. Of sides whose nodes cannot carry a pressure (ContactFace) a pair is the mean of the gap with the dual weight
/// of a node (mortarPairs). Local.
/// \param problems  gets a side none of whose nodes has the obstacle in front, or with nodes that are inside the obstacle and face away
/// \param notes     gets the number of nodes left out
PairedSurface obstaclePairs(const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

}  // namespace suture
