#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <utility>
#include <vector>

namespace suture {

/// Opposite nodes (a, b) of the two faces of one contact.
using NodePairs = std::vector<std::pair<int, int>>;

/// Opposite nodes of each contact between two faces: those of matchingPairs(), also across a gap; where the faces do not match as a whole,
/// the nodes that coincide (to 1e-6 of the distance to the nearest adjacent node). Empty for obstacles and for faces with a problem, which
/// contactsOn() reports. Local (rank 0). \param mesh  without coatings \throws InternalError  coatings
std::vector<NodePairs> contactTwins(const Mesh& mesh, const std::vector<Contact>& contacts);

}  // namespace suture
