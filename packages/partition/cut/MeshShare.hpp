#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/NodeSubdomains.hpp>

#include <string>
#include <vector>

namespace suture {

/// The bodies that a rank cuts into subdomains, in local numbers, which keep the order of the mesh. Bodies are whole and share no node:
/// neither neighbours nor seams lead to another rank.
struct MeshShare {
  std::vector<std::string> bodies;               ///< names of all bodies; on all ranks
  std::vector<int> rankOf;                       ///< body -> rank that cuts it; on all ranks; empty: rank 0 cuts all
  bool whole = false;                            ///< this rank has all bodies: the block is the mesh itself
  CellBlock own;                                 ///< if not whole: elements and nodes of this rank's bodies
  std::vector<int> globalNodes, globalElements;  ///< local -> mesh, ascending; empty if whole
  std::vector<int> bodyOfElement;
  std::vector<int> subdomainOfElement;  ///< set after cutting
  NodeSubdomains holders;               ///< subdomains that hold each node, set after cutting

  /// \param mesh  mesh that the share was made from
  const CellBlock& block(const CellBlock& mesh) const { return whole ? mesh : own; }
  GlobalId globalNode(int local) const { return whole ? local : globalNodes[local]; }
  GlobalId globalElement(int local) const { return whole ? local : globalElements[local]; }
  int rankOfBody(int body) const { return rankOf.empty() ? 0 : rankOf[body]; }
  /// Local number, or -1 if the node or element is not in this share.
  int localNode(GlobalId global) const { return localOf(globalNodes, global); }
  int localElement(GlobalId global) const { return localOf(globalElements, global); }

 private:
  int localOf(const std::vector<int>& numbers, GlobalId global) const;
};

/// Sends every body to a rank, balanced by elements; a single body stays on rank 0. Collective.
MeshShare shareBodies(const Comm& comm, const Mesh& mesh);

/// Share of the whole mesh, already cut. Local (rank 0).
MeshShare wholeShare(const Mesh& mesh, const std::vector<int>& subdomainOfElement);

/// Sends every rank the subdomains of its elements, from rank 0. Collective.
void shareSubdomains(const Comm& comm, const Mesh& mesh, const std::vector<int>& subdomainOfElement, MeshShare& share);

/// Inverse of shareSubdomains(): subdomain of every element of the mesh on rank 0, empty on other ranks. Collective.
std::vector<int> gatherSubdomains(const Comm& comm, const Mesh& mesh, const MeshShare& share);

/// Holders of the given nodes of the mesh; other nodes have none. Collective.
/// \param nodes  on rank 0
/// \return on rank 0, empty on other ranks
NodeSubdomains gatherHolders(const Comm& comm, const Mesh& mesh, const MeshShare& share, std::vector<int> nodes);

}  // namespace suture
