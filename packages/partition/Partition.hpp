#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

struct MeshShare;

/// Subdomain of each element, subdomains of each contact group, and the ranks on which they live. The same on all ranks, except the first
/// two members, which only rank 0 has, and share, which each rank has for itself.
struct Partition {
  std::vector<int> subdomainOfElement;     ///< rank 0 only
  bool bodiesAreConnected = false;         ///< each body is one part, as found for METIS; false: not known; rank 0 only
  std::vector<std::string> names;          ///< names of the subdomains: group name, or "<body> <number>"
  std::vector<int> bodyOf;                 ///< subdomain -> body
  std::vector<int> elementsOf;             ///< subdomain -> number of elements
  std::vector<long long> costOf;           ///< subdomain -> expected work, in nodes; used to balance ranks
  std::vector<int> groupOf;                ///< subdomain -> contact group, or -1
  std::vector<std::vector<int>> groups;    ///< contact group -> its subdomains, ascending
  std::vector<std::vector<int>> piecesOf;  ///< contact group -> its contact pieces
  std::vector<std::string> notes;          ///< sentences for the user: notes of the constraints, and repairs
  std::vector<int> rankOf;                 ///< subdomain -> rank; the same for all subdomains of a group if groups are kept whole
  std::shared_ptr<const MeshShare> share;  ///< part that this rank cut, for distribute(); null: distribute() shares the mesh again
  int subdomains() const { return static_cast<int>(names.size()); }
};

/// Schema of the scene's list `Partition`.
Schema partitionSchema();

/// Cuts the mesh: METIS, each body separately, in proportion to its elements (at least one subdomain per body), connected through sides,
/// fixed seed; or the element groups that match a pattern, each inside one body. Then finds contact groups (all subdomains that touch a
/// piece; pieces that share a subdomain make one group) and places subdomains on ranks (groups whole, balanced by expected cost).
/// Subdomains are numbered along a space-filling curve; unless groups are kept whole, each rank has consecutive numbers. The result is the
/// same for the same mesh on any number of ranks, except rankOf. Collective.
///
/// \param partition        the scene's list `Partition`. With METIS/Subdomains = Automatic the number may depend on the number of ranks.
/// \param keepGroupsWhole  false for the formulation Contact On The Interface, which does not need a group on one rank; groups are still
///                         found
/// \throws InputError  unknown pattern (known groups), an element in two subdomains or in none, a named subdomain in two bodies or not
///                     connected, more subdomains than elements, fewer subdomains than connected parts of the bodies; a body whose parts
///                     connected by single nodes only.
Partition makePartition(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Parameters& partition,
                        bool keepGroupsWhole = true);

/// Converts all members except subdomainOfElement, bodiesAreConnected and share to bytes, for a message or a file, and back. Local.
std::string packed(const Partition& partition);
void unpackInto(const std::string& bytes, Partition& partition);

/// Sets rankOf again, for another number of ranks or other requirements. Local; the same on all ranks.
void placeOnRanks(Partition& partition, bool keepGroupsWhole, int ranks);

}  // namespace suture
