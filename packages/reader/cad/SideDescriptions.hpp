#pragma once
#include <suture/mesh/Mesh.hpp>

#include <map>
#include <string>

namespace suture {

/// Shapes of the side groups of a CAD file, in words: "cylinder, radius 6, along z, hollow". By name of the group.
using SideDescriptions = std::map<std::string, std::string>;

/// readMesh(), and the descriptions of its side groups: on rank 0, and only for a CAD file. Collective.
Mesh readMesh(const Comm& comm, const Parameters& mesh, const std::string& folder, SideDescriptions& descriptions);

}  // namespace suture
