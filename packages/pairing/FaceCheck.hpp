#pragma once
#include <suture/mesh/SideTable.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// One face of a contact on the mesh; without a surface after a problem. Local.
/// \param table  knows the sides of its groups;  \param path  of the parameter that names them
/// \param problems  gets: an unknown or empty group, a face inside the material, sides of different order, branches, sharp corners
ContactFace readFace(const Mesh& mesh, const SideTable& table, const std::vector<std::string>& groups, const std::string& path,
                     Problems& problems);

}  // namespace suture
