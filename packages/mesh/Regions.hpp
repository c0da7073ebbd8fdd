#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// An entry of the scene's list `Bodies/<body>/Regions`: a part of a body with its own material.
struct RegionEntry {
  std::string body;
  const Parameters* list;  ///< list of the scene, which must outlive it
};

/// All regions of the scene, body by body, in the order of the file, as numbered in CellBlock::regions. Local.
/// \param bodies  the scene's list `Bodies`
std::vector<RegionEntry> regionEntries(const Parameters& bodies);

/// Assigns every element its region by the entries' parameter `Group`; without regions the mesh is unchanged. Call after assignBodies().
/// \throws InputError  all of: a group that the mesh does not have (nearest name, known groups), an empty group, a group that extends
///                     outside its body, an element in two regions.  Local (rank 0).
void assignRegions(Mesh& mesh, const Parameters& bodies);

}  // namespace suture
