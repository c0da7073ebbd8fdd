#pragma once
#include <suture/mesh/SideGroups.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// The mesh of a scene: bodies that share no node, and named groups of elements and of boundary sides. Held on rank 0 (empty elsewhere)
/// until it is partitioned and distributed.
struct Mesh : CellBlock {
  std::string source;                                     ///< file, for messages
  std::vector<std::string> notes;                         ///< sentences for the user about changes of the mesh
  std::map<std::string, std::vector<int>> elementGroups;  ///< bodies, named subdomains; see elementGroupKind()
  SideGroups sideGroups;                                  ///< boundary conditions, contact sides; see sideGroupKind()
  std::vector<std::string> bodies;                        ///< names, in the order of the scene; see assignBodies()
  std::vector<int> bodyOfElement;
  std::vector<int> bodyOfNode;

  /// Gmsh's terms, used in messages: "surface group", in 3D "volume group"; and "curve group", in 3D "surface group".
  std::string elementGroupKind() const { return dimension == 2 ? "surface group" : "volume group"; }
  std::string sideGroupKind() const { return dimension == 2 ? "curve group" : "surface group"; }
  std::vector<std::string> elementGroupNames() const;
  std::vector<std::string> sideGroupNames() const;
  /// Hexadecimal hash of coordinates, elements and groups, for provenance.
  std::string hash() const;
};

/// Message about an invalid side group: the mesh has no such group (with the nearest name and all names), or the group is empty; "" if it
/// is valid. Local.
std::string sideGroupProblem(const Mesh& mesh, const std::string& group);

/// Assigns every element to a body: `names` are element groups. Then checks the whole mesh.
/// \throws InputError  all of: a body that is no group (nearest name, known groups); an element in two bodies or in none; two bodies that
///                     share a node; orphan nodes; inverted or zero-area elements (with location and area); non-conforming elements in 3D
///                     (checkSidesFit()).  Local (rank 0).
void assignBodies(Mesh& mesh, const std::vector<std::string>& names);

/// Makes the mesh the meridian half plane of bodies of revolution (CellBlock::axisymmetric). Nodes closer to the axis than 1e-10 of the
/// mesh's extent are moved onto it. \throws InputError  nodes with negative x: number and location.  Local (rank 0).
void makeAxisymmetric(Mesh& mesh);

}  // namespace suture
