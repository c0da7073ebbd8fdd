#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

struct MeshShare;

/// Subdomain of each element, subdomains of each contact group, and the ranks on which they live. The same on all ranks
/// but for the first two, which only rank 0 has, and share, which is each rank's own.
struct Partition {
  std::vector<int> subdomainOfElement;     ///< rank 0 only
  bool bodiesAreConnected = false;         ///< each body is one part, as METIS needed to know; false: not known; rank 0 only
  std::vector<std::string> names;          ///< names of the subdomains: group name, or "<body> <number>"
  std::vector<int> bodyOf;                 ///< subdomain -> body
  std::vector<int> elementsOf;             ///< subdomain -> number of elements
  std::vector<long long> costOf;           ///< subdomain -> expected work, in nodes; what ranks are balanced by
  std::vector<int> groupOf;                ///< subdomain -> contact group, or -1
  std::vector<std::vector<int>> groups;    ///< contact group -> its subdomains, ascending
  std::vector<std::vector<int>> piecesOf;  ///< contact group -> its contact pieces
  std::vector<std::string> notes;          ///< sentences for the user: of the constraints, and what was repaired
  std::vector<int> rankOf;                 ///< subdomain -> rank; the subdomains of a group share one, if groups are kept whole
  std::shared_ptr<const MeshShare> share;  ///< part that this rank cut, for distribute(); null: distribute() shares the mesh anew
  int subdomains() const { return static_cast<int>(names.size()); }
};

/// The scene's list `Partition`.
Schema partitionSchema();

/// Cuts the mesh: METIS, each body on its own in proportion to its elements (at least one subdomain a body), connected through sides,
/// fixed seed; or the element groups that match a pattern, each inside one body. Then finds contact groups (all subdomains that touch a
/// piece; pieces that share a subdomain make one group) and places subdomains on ranks (groups whole, balanced by expected cost). The
/// same result for the same mesh on any number of ranks, but for rankOf. Collective.
///
/// \param partition        the scene's list `Partition`. With METIS/Subdomains = Automatic their number may depend on that of the ranks.
/// \param keepGroupsWhole  false for the formulation Contact On The Interface, which needs no group on one rank; groups are found all the
///                         same
/// \throws InputError  unknown pattern (known groups), an element in two subdomains or in none, a named subdomain in two bodies or not
///                     connected, more subdomains than elements, fewer subdomains than connected parts of the bodies; a body whose parts
///                     hang together in single nodes only.
Partition makePartition(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Parameters& partition,
                        bool keepGroupsWhole = true);

/// All but subdomainOfElement, bodiesAreConnected and share, for a message or a file, and back. Local.
std::string packed(const Partition& partition);
void unpackInto(const std::string& bytes, Partition& partition);

/// Gives rankOf anew, for another number of ranks or other needs than it was made for. Local; the same on all ranks.
void placeOnRanks(Partition& partition, bool keepGroupsWhole, int ranks);

}  // namespace suture
