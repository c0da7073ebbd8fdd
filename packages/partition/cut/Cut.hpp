#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/cut/MeshShare.hpp>

#include <string>
#include <vector>

namespace suture {

/// Subdomain of each element: the result of cutting a mesh.
struct Cut {
  std::vector<int> subdomainOfElement;  ///< subdomain of each element of the mesh
  std::vector<std::string> names;       ///< names of the subdomains
  std::vector<int> bodyOf;              ///< subdomain -> body
  std::vector<std::string> notes;       ///< sentences for the user about repairs
  bool bodiesAreConnected = false;      ///< each body is one part; false: not known
};

/// Schemas of the lists `METIS` and `Named Groups`.
Schema metisSchema();
Schema namedGroupsSchema();

/// METIS cuts every body separately, in proportion to its elements; disconnected parts of a body are cut separately, too. Every rank cuts
/// the bodies of its share; the cut does not depend on the ranks. Subdomains = Automatic makes at least one subdomain per rank if there are
/// enough elements. Collective.
/// \param mesh   mesh that the share was made from
/// \param own    the scene's list `METIS`
/// \param share  gets its subdomains and their holders
/// \return names, bodies and notes on rank 0, empty on other ranks
/// \throws InputError  more subdomains than elements, fewer than connected parts of the bodies, a hinge (findHinges)
Cut cutByMetis(const Comm& comm, const Mesh& mesh, const Parameters& own, MeshShare& share);

/// Makes a subdomain of every element group that matches the pattern, in alphabetical order.
/// \param own  the scene's list `Named Groups`
/// \throws InputError  all of: no group matches, an element in two groups or in none, a group without elements, in two bodies or not
///                     connected through sides; a hinge (findHinges). Local (rank 0).
Cut cutByNamedGroups(const Mesh& mesh, const Parameters& own);

/// Number of subdomains for Automatic: one per CostModel::kElements, rounded to the nearest multiple of four, which two and four ranks
/// share evenly (Hertz at 100k on two ranks: 0.26 s in all with 12, 0.29 with 13). Up to six of 800 elements in small scenes, at
/// least `pieces`, and at least `ranks` if each rank gets 50 elements. Local.
int automaticSubdomains(int elements, int pieces, int ranks);
/// Number of subdomains for Automatic in 3D: one per CostModel::kNodesInSpace.
int automaticSubdomainsInSpace(int nodes, int elements, int pieces, int ranks);

}  // namespace suture
