#pragma once
#include <suture/base/Errors.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

namespace suture {

/// Bodies whose parts hang together in single nodes only: on either side of such a node the body is free to turn, and the solution around
/// it depends on the mesh (the displacement of a point means nothing in plane elasticity). They are refused. A body that touches itself in
/// a node but is connected through sides elsewhere has no hinge, nor has one whose parts have no node in common. Local.
/// \param bodies    names of all
/// \param parts     connected parts of the bodies
/// \param problems  gets a line for each such body: how many parts, where they meet
void findHinges(const CellBlock& block, const std::vector<int>& bodyOfElement, const std::vector<std::string>& bodies,
                const Components& parts, Problems& problems);

}  // namespace suture
