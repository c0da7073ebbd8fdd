#pragma once
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/NodeSubdomains.hpp>

#include <string>
#include <vector>

namespace suture {

/// The bodies that a rank cuts into subdomains. Bodies are whole and share no node, so that neither neighbours nor seams lead to another
/// rank. In local numbers, which are in the order of the mesh's.
struct MeshShare {
  std::vector<std::string> bodies;               ///< names of all; on all ranks
  std::vector<int> rankOf;                       ///< body -> rank that cuts it; on all ranks; empty: rank 0 cuts all
  bool whole = false;                            ///< all of them are this rank's: the block is the mesh itself
  CellBlock own;                                 ///< if not whole: elements and nodes of this rank's bodies
  std::vector<int> globalNodes, globalElements;  ///< local -> mesh, ascending; empty if whole
  std::vector<int> bodyOfElement;
  std::vector<int> subdomainOfElement;  ///< once they are cut
  NodeSubdomains holders;               ///< holders of each node, once they are cut

  /// \param mesh  mesh that the share was made from
  const CellBlock& block(const CellBlock& mesh) const { return whole ? mesh : own; }
  GlobalId globalNode(int local) const { return whole ? local : globalNodes[local]; }
  GlobalId globalElement(int local) const { return whole ? local : globalElements[local]; }
  int rankOfBody(int body) const { return rankOf.empty() ? 0 : rankOf[body]; }
  /// -1: not here.
  int localNode(GlobalId global) const { return localOf(globalNodes, global); }
  int localElement(GlobalId global) const { return localOf(globalElements, global); }

 private:
  int localOf(const std::vector<int>& numbers, GlobalId global) const;
};

/// Sends every body to a rank, balanced by elements; all stay on rank 0 if there is one only. Collective.
MeshShare shareBodies(const Comm& comm, const Mesh& mesh);

/// The whole mesh as one share, cut. Local (rank 0).
MeshShare wholeShare(const Mesh& mesh, const std::vector<int>& subdomainOfElement);

/// Sends every rank the subdomains of its elements, which rank 0 knows. Collective.
void shareSubdomains(const Comm& comm, const Mesh& mesh, const std::vector<int>& subdomainOfElement, MeshShare& share);

/// The way back: subdomain of every element of the mesh on rank 0, nothing elsewhere. Collective.
std::vector<int> gatherSubdomains(const Comm& comm, const Mesh& mesh, const MeshShare& share);

/// Holders of some nodes of the mesh; the others have none. Collective.
/// \param nodes  on rank 0
/// \return on rank 0, nothing elsewhere
NodeSubdomains gatherHolders(const Comm& comm, const Mesh& mesh, const MeshShare& share, std::vector<int> nodes);

}  // namespace suture
