#pragma once
#include <suture/interface/InterfaceSpace.hpp>

#include <vector>

namespace suture {

/// Edges or faces of closed pairs in a space with relations. `single`, and all other unknowns whose sharers were joined by a relation and
/// that are on no edge or face, become vertices. Local; ranks that share entities find them in the same order.
/// \param neighbours  see InterfaceSpace::related()
/// \param single      by place: unknowns that have no neighbour
std::vector<InterfaceEntity> contactEntities(const InterfaceSpace& space, const std::vector<std::vector<int>>& neighbours,
                                             std::vector<char> single);

}  // namespace suture
