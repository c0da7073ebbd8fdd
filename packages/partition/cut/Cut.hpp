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

/// Every body on its own, in proportion to its elements; a body of several disconnected parts, each part on its own. Every rank cuts the
/// bodies of its share; the cut does not depend on the ranks. Subdomains = Automatic makes at least one a rank where the elements allow
/// it. Collective.
/// \param mesh   mesh that the share was made from
/// \param own    the list `METIS`
/// \param share  gets its subdomains and their holders
/// \return names, bodies and notes on rank 0, nothing elsewhere
/// \throws InputError  more subdomains than elements, fewer than connected parts of the bodies, a hinge (findHinges)
Cut cutByMetis(const Comm& comm, const Mesh& mesh, const Parameters& own, MeshShare& share);

/// Every element group that matches the pattern is a subdomain, in alphabetical order.
/// \param own  the list `Named Groups`
/// \throws InputError  all of: no group matches, an element in two of them or in none, a group without elements, in two bodies or not
///                     connected through sides; a hinge (findHinges). Local (rank 0).
Cut cutByNamedGroups(const Mesh& mesh, const Parameters& own);

/// The number of subdomains that Automatic stands for: one for every CostModel::kElements, to the nearest multiple of four, which two and
/// four ranks share evenly (Hertz at 100k on two ranks: 0.26 s in all with 12, 0.29 with 13). Up to six of 800 elements in small scenes, at
/// least `pieces`, and at least `ranks` as long as each has 50 elements. Local.
int automaticSubdomains(int elements, int pieces, int ranks);
/// The same in space, where there is one for every CostModel::kNodesInSpace.
int automaticSubdomainsInSpace(int nodes, int elements, int pieces, int ranks);

}  // namespace suture
