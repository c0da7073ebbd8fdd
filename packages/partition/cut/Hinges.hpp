#pragma once
#include <suture/base/Errors.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

namespace suture {

/// Refuses bodies whose parts are connected by single nodes only: the parts can rotate about such a node, and the solution around it
/// depends on the mesh (the displacement of a point is meaningless in plane elasticity). A body that touches itself in a node but is
/// connected through sides elsewhere has no hinge, nor has a body whose parts have no common node. Local.
/// \param bodies    names of all bodies
/// \param parts     connected parts of the bodies
/// \param problems  gets a line for each such body: number of parts, common nodes
void findHinges(const CellBlock& block, const std::vector<int>& bodyOfElement, const std::vector<std::string>& bodies,
                const Components& parts, Problems& problems);

}  // namespace suture
