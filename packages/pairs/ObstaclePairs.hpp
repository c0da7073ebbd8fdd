#pragma once
#include <suture/pairs/ContactPairs.hpp>

namespace suture {

/// Pairs of a contact with a rigid obstacle: one for each node of side A that faces the obstacle, with the normal and distance of the
/// obstacle there, or of the side (Contact::Direction). Nodes whose normal differs from the direction to the obstacle by more than 60
/// degrees, across a gap, have no pair, e.g. on a flat side beyond a bump. On sides whose nodes cannot carry a pressure (ContactFace) a
/// pair is the mean of the gap with the dual weight of a node (mortarPairs). Local.
/// \param problems  receives a side none of whose nodes faces the obstacle, or with nodes inside the obstacle that face away from it
/// \param notes     receives the number of nodes left out
PairedSurface obstaclePairs(const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

}  // namespace suture
