#pragma once
#include <suture/mesh/SideTable.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// One face of a contact on the mesh; has no surface after a problem. Local.
/// \param table  contains the sides of the groups;  \param path  of the parameter that names the groups
/// \param problems  receives: an unknown or empty group, a face inside the material, sides of different order, branches, sharp corners
ContactFace readFace(const Mesh& mesh, const SideTable& table, const std::vector<std::string>& groups, const std::string& path,
                     Problems& problems);

}  // namespace suture
