#pragma once
#include <suture/mesh/SideGroups.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// The mesh of a scene: bodies that share no node, and named groups of elements and of boundary sides. It lives on rank 0 (empty
/// elsewhere) until it is cut and distributed.
struct Mesh : CellBlock {
  std::string source;                                     ///< file, for messages
  std::map<std::string, std::vector<int>> elementGroups;  ///< bodies, named subdomains; see elementGroupKind()
  SideGroups sideGroups;                                  ///< boundary conditions, contact sides; see sideGroupKind()
  std::vector<std::string> bodies;                        ///< names, in the order of the scene; see assignBodies()
  std::vector<int> bodyOfElement;
  std::vector<int> bodyOfNode;

  /// Words of users, who know Gmsh's: "surface group", in space "volume group"; and "curve group", in space "surface group".
  std::string elementGroupKind() const { return dimension == 2 ? "surface group" : "volume group"; }
  std::string sideGroupKind() const { return dimension == 2 ? "curve group" : "surface group"; }
  std::vector<std::string> elementGroupNames() const;
  std::vector<std::string> sideGroupNames() const;
  /// Hexadecimal hash of coordinates, elements and groups, for provenance.
  std::string hash() const;
};

/// What is wrong with the name of a side group, for messages: that the mesh has no such group, with the nearest name and all names, or that
/// no side is in it; empty if nothing is. Local.
std::string sideGroupProblem(const Mesh& mesh, const std::string& group);

/// Gives every element its body: `names` are element groups. Then checks the mesh as a whole.
/// \throws InputError  all of: a body that is no group (nearest name, known groups); an element in two bodies or in none; two bodies that
///                     share a node; orphan nodes; inverted or zero-area elements (names place and area); elements in space that do
///                     not fit each other (checkSidesFit()).  Local (rank 0).
void assignBodies(Mesh& mesh, const std::vector<std::string>& names);

/// Makes the mesh the meridian half plane of bodies of revolution (CellBlock::axisymmetric). Nodes within 1e-10 of the mesh's extent of the
/// axis are put on it. \throws InputError  nodes with negative x: how many, where.  Local (rank 0).
void makeAxisymmetric(Mesh& mesh);

}  // namespace suture
